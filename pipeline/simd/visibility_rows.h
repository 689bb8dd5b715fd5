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
    // Results; both rows are written up to 16 pixels beyond the last pixel.
    std::uint8_t* visibility;  ///< 0, 255 or kOpen
    float* inverse;            ///< inverse depth of the layer [1/m]
};
/// Value in DecideRow::visibility for a pixel that decideRow() leaves to weighOpenPixels().
inline constexpr std::uint8_t kOpen = 1;

/// Writes the visibility of the layer's pixels: 255 if the pixel is certainly in front of the real
/// scene, 0 if it is certainly behind it or has no depth, otherwise kOpen (visibility_decide.frag).
/// Returns true if any pixel is kOpen.
bool decideRow(const DecideRow& row, const VisibilityParams& params);

/// Index of pixel 0 in the rows of SampleWindow.
inline constexpr int kSampleMargin = 2;
/// The four rows of depth samples around an output row, and their weights by vertical distance.
struct SampleWindow {
    std::array<SampleRow, 4> rows;
    std::array<float, 4> weights;
};

struct OpenRow {
    int count;
    /// For each pixel: index of the first of its four samples, and the four weights by horizontal
    /// distance.
    const std::int32_t* column;
    const float* weights;
    const std::uint32_t* picture;  ///< RGBA8
    const float* inverse;
    std::uint8_t* visibility;
};

/// Replaces kOpen by the pixels' visibility [0, 255]. Depth samples are weighed by distance, and by
/// the similarity of the video's colour at the sample to the picture's colour at the pixel
/// (visibility_sample.frag).
void weighOpenPixels(const OpenRow& row, const SampleWindow& samples,
                     const VisibilityParams& params);

}  // namespace mfar::simd
