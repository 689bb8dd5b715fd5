#include "pipeline/gles/luma_pyramids.h"

#include "base/camera_lens.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

gpu::Groups groupsOf(const LumaLevel& level) {
    return {gpu::groupsFor(level.pitch, 8), gpu::groupsFor(level.height, 8), 1};
}

}  // namespace

params::Rig rigParams(const StereoRig& rig) {
    const auto rotation = rowsOf(rig.T_still_video.rotation);
    return {.video = lensOf(rig.video),
            .still = lensOf(rig.still),
            .rotation = {rotation[0], rotation[1], rotation[2]}};
}

LumaPyramids::LumaPyramids(Size video)
    : fromVideo_("luma_from_video.comp"), fromStill_("luma_from_still.comp"),
      down_("luma_down.comp") {
    std::int32_t words = 0;
    video_ = lumaLayout(video, words);
    still_ = lumaLayout(video, words);
    words_ =
        gpu::Buffer((static_cast<std::size_t>(words) + kLumaSpareWords) * sizeof(std::uint32_t));
}

void LumaPyramids::buildVideo(const gpu::Texture& video) {
    fromVideo_.run({.target = video_[0], .smoothing = kLumaSmoothing},
                   {gpu::sampler(0, video), gpu::storage(0, words_)}, groupsOf(video_[0]));
    buildCoarse(video_);
}

void LumaPyramids::buildStill(const gpu::Texture& still, const ToneTexture& tone,
                              const StereoRig& rig, float light) {
    const double footprint = lumaBoxWidening() * rig.still.fx / rig.video.fx;
    fromStill_.run(
        {.rig = rigParams(rig),
         .target = still_[0],
         .texelX = static_cast<float>(1.0 / still.size().width),
         .texelY = static_cast<float>(1.0 / still.size().height),
         .footprint = static_cast<float>(footprint),
         .light = light},
        {gpu::sampler(0, still), gpu::sampler(1, tone.texture()), gpu::storage(0, words_)},
        groupsOf(still_[0]));
    buildCoarse(still_);
}

void LumaPyramids::buildSecond(const gpu::Texture& picture) {
    fromVideo_.run({.target = still_[0], .smoothing = kLumaSmoothing},
                   {gpu::sampler(0, picture), gpu::storage(0, words_)}, groupsOf(still_[0]));
    buildCoarse(still_);
}

void LumaPyramids::buildCoarse(const std::vector<LumaLevel>& levels) {
    for (std::size_t i = 1; i < levels.size(); ++i)
        down_.run({.fine = levels[i - 1], .coarse = levels[i]}, {gpu::storage(0, words_)},
                  groupsOf(levels[i]));
}

}  // namespace mfar
