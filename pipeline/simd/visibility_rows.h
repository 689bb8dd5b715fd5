#pragma once

#include "pipeline/engine/occlusion_options.h"
#include "pipeline/simd/depth_samples.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

/// Number of pixels of an output row that are processed at a time. Rows of this length have 64
/// bytes of padding.
inline constexpr int kVisibilityChunk = 256;

/// CompositeOptions in single precision.
struct VisibilityParams {
    explicit VisibilityParams(const CompositeOptions& options);
    SampleBounds bounds;
    float perSoftness;   ///< 1 / CompositeOptions::softness [1 / sigma]
    float virtualSigma;  ///< CompositeOptions::virtualSigma [share of the depth]
    float likeness;      ///< factor of a squared colour difference [1 / grey level^2]
};

/// Input and result of decideRow() for a part of an output row.
struct DecideRow {
    int count;
    const float* z;                 ///< z of the virtual layer [m]
    const float *greatest, *least;  ///< see rangeOfSamples(), for each pixel
    std::uint8_t* visibility;       ///< 0, 255 or kOpen; written up to 16 pixels beyond the last
    float* inverse;                 ///< layer's inverse depth [1/m]; written as far as `visibility`
};
inline constexpr std::uint8_t kOpen = 1;  ///< this pixel's samples have to be weighed

/// Decides which pixels of the layer are certainly in front of the real scene or behind it
/// (visibility_decide.frag). Returns true if any pixel is left open.
bool decideRow(const DecideRow& row, const VisibilityParams& params);

/// The samples around an output row: four rows. Pixel 0 is entry kSampleMargin of each.
inline constexpr int kSampleMargin = 2;
struct SampleWindow {
    std::array<SampleRow, 4> rows;
    std::array<float, 4> weights;  ///< weights of the rows, by their distance from the output row
};

/// A part of an output row whose open pixels are weighed.
struct OpenRow {
    int count;
    const std::int32_t* column;    ///< for each pixel, index of the first of its four samples
    const float* weights;          ///< for each pixel, weights of its four samples by distance
    const std::uint32_t* picture;  ///< RGBA8
    const float* inverse;
    std::uint8_t* visibility;
};

/// Computes the visibility of open pixels. Samples are weighed by distance, and by how similar the
/// picture is to the video there (visibility_sample.frag).
void weighOpenPixels(const OpenRow& row, const SampleWindow& samples,
                     const VisibilityParams& params);

}  // namespace mfar::simd
