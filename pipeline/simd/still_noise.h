#pragma once

#include "base/image_view.h"
#include "pipeline/flow/luma_image.h"

namespace mfar::simd {

/// Measures the noise of stills. Noise and fine texture differ in what halving the picture leaves
/// of them: half of the standard deviation of white noise, but about all of the contrast of
/// texture, because natural textures have as much contrast at twice the scale. So the noise is
/// computed from the difference of BlockNoise between the still and its halved copy.
class StillNoise {
public:
    /// Returns the standard deviation of the noise in the luma of a valid still [grey levels]. Up
    /// to 480 rows are read. If a still is too small to be measured, the result is 0.
    [[nodiscard]] double of(const ImageView& still);

private:
    BlockNoise whole_, half_;
};

}  // namespace mfar::simd
