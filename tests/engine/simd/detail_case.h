#pragma once

#include "pipeline/simd/detail_step.h"
#include "pipeline/simd/still_preparation.h"

#include <vector>

namespace mfar::simd {

/// Input of the detail step that resembles a real frame: textured pictures, smooth flow with a
/// nearer rectangle in front of a background, varying weights, and areas without weight.
struct DetailCase {
    DetailCase(Size video, Size still, double changedShare = 1);

    [[nodiscard]] ImageView stillView(PixelFormat format = PixelFormat::Rgba8) const;
    [[nodiscard]] ImageView videoView() const;
    [[nodiscard]] DetailInput input(StillPreparation* still) const;

    StereoRig rig;
    std::vector<std::uint8_t> videoPixels, stillPixels;  // RGBA8
    RgbPlanes video;
    TileWork work;
    Size cells;
    std::vector<WeighedCell> weighed;
    std::vector<LookUpCell> lookUps;
    std::vector<TrustCell> trust;
};

[[nodiscard]] StereoRig idealRig(Size video, Size still);

}  // namespace mfar::simd
