#pragma once

#include "pipeline/engine/occlusion_options.h"
#include "pipeline/simd/depth_samples.h"

#include <array>
#include <cstdint>

namespace mfar::simd {

/// Number of pixels of an output row that are processed at a time. Arrays for them have 64 bytes of
/// padding.
inline constexpr int kVisibilityChunk = 256;

struct VisibilityParams {
    explicit VisibilityParams(const CompositeOptions& options);
    SampleBounds bounds;
    float perSoftness;   ///< 1 / CompositeOptions::softness [1 / sigma]
    float virtualSigma;  ///< CompositeOptions::virtualSigma [share of the depth]
    float likeness;      ///< factor of a squared colour difference [1 / grey level^2]
};

struct DecideRow {
    int count;
    const float* z;                 ///< z of the virtual layer [m]
    const float *greatest, *least;  ///< for each pixel, see rangeOfSamples()
    std::uint8_t* visibility;       ///< 0, 255 or kOpen; written up to 16 pixels beyond the last
                                    ///< pixel
    float* inverse;                 ///< inverse depth of the layer [1/m]; written as far as
                                    ///< `visibility`
};
inline constexpr std::uint8_t kOpen = 1;  ///< visibility of a pixel whose samples must be weighed

/// Decides which pixels of the layer are certainly in front of or behind the real scene
/// (visibility_decide.frag). Other pixels stay open. Returns true if any pixel is open.
bool decideRow(const DecideRow& row, const VisibilityParams& params);

/// The four rows of samples around an output row. Pixel 0 is entry kSampleMargin of each row.
inline constexpr int kSampleMargin = 2;
struct SampleWindow {
    std::array<SampleRow, 4> rows;
    std::array<float, 4> weights;
};

struct OpenRow {
    int count;
    /// For each pixel: index of the first of its four samples, and the samples' weights by
    /// distance.
    const std::int32_t* column;
    const float* weights;
    const std::uint32_t* picture;  ///< RGBA8
    const float* inverse;
    std::uint8_t* visibility;
};

/// Computes the visibility of the pixels that decideRow() left open. Samples are weighed by
/// distance and by the similarity of picture and video (visibility_sample.frag).
void weighOpenPixels(const OpenRow& row, const SampleWindow& samples,
                     const VisibilityParams& params);

}  // namespace mfar::simd
