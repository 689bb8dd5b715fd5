#pragma once

#include "base/image_view.h"

namespace mfar::simd {

/// Returns the standard deviation of the noise in the luma of a valid still [grey levels]. Up to
/// 480 rows are read. If a still is too small to be measured, the result is 0.
///
/// Halving the picture halves the standard deviation of white noise, but hardly changes the
/// contrast of texture, because natural textures have as much contrast at twice the scale. So the
/// noise is computed from the difference between the variances (squares of BlockNoise) of the still
/// and of its halved copy.
[[nodiscard]] double noiseOfStill(const ImageView& still);

}  // namespace mfar::simd
