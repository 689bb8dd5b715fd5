#pragma once

#include "pipeline/simd/detail_step.h"
#include "pipeline/simd/still_preparation.h"

#include <vector>

namespace mfar::simd {

/// Input of the detail step that resembles a real frame. It has textured pictures, the smooth flow
/// of a scene at several distances with a curved border, varying weights, and areas without weight.
struct DetailCase {
    /// `changedShare`: share of the tiles that changed, spread over the picture; 1: a whole frame.
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

/// Two cameras without distortion at the same place. The still shows the video's view at another
/// resolution.
[[nodiscard]] StereoRig idealRig(Size video, Size still);

}  // namespace mfar::simd
