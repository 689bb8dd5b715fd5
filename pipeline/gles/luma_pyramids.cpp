#include "pipeline/gles/luma_pyramids.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

gpu::Groups groupsOf(const LumaLevel& level) {
    return {gpu::groupsFor(level.pitch, 8), gpu::groupsFor(level.height, 8), 1};
}

void put(float (&out)[4], double a, double b, double c, double d) {
    out[0] = static_cast<float>(a);
    out[1] = static_cast<float>(b);
    out[2] = static_cast<float>(c);
    out[3] = static_cast<float>(d);
}

}  // namespace

RigParams rigParams(const StereoRig& rig) {
    RigParams p{};
    const auto& v = rig.video;
    const auto& s = rig.still;
    put(p.videoPinhole, v.fx, v.fy, v.cx, v.cy);
    put(p.videoDistortion, v.distortion[0], v.distortion[1], v.distortion[2], v.distortion[3]);
    put(p.stillPinhole, s.fx, s.fy, s.cx, s.cy);
    put(p.stillDistortion, s.distortion[0], s.distortion[1], s.distortion[2], s.distortion[3]);
    put(p.k3, v.distortion[4], s.distortion[4], 0, 0);
    const Eigen::Matrix3d r = rig.T_still_video.rotation.toRotationMatrix();
    for (int i = 0; i < 3; ++i)
        put(p.rotation[i], r(i, 0), r(i, 1), r(i, 2), 0);
    return p;
}

LumaPyramids::LumaPyramids(Size video)
    : fromVideo_("luma_from_video.comp"), fromStill_("luma_from_still.comp"),
      down_("luma_down.comp") {
    std::int32_t words = 0;
    video_ = lumaLayout(video, words);
    still_ = lumaLayout(video, words);
    // A patch row reads three words from any column on: two spare ones end the buffer.
    words_ = gpu::Buffer((static_cast<std::size_t>(words) + 2) * sizeof(std::uint32_t));
}

void LumaPyramids::buildVideo(const gpu::Texture& video) {
    fromVideo_.run({video_[0], {kLumaSmoothing}}, {gpu::sampler(0, video), gpu::storage(0, words_)},
                   groupsOf(video_[0]));
    buildCoarse(video_);
}

void LumaPyramids::buildStill(const gpu::Texture& still, const StereoRig& rig) {
    StillParams p{};
    p.rig = rigParams(rig);
    p.target = still_[0];
    put(p.stillTexel, 1.0 / still.size().width, 1.0 / still.size().height,
        lumaBoxWidening() * rig.still.fx / rig.video.fx, 0);
    fromStill_.run(p, {gpu::sampler(0, still), gpu::storage(0, words_)}, groupsOf(still_[0]));
    buildCoarse(still_);
}

void LumaPyramids::buildSecond(const gpu::Texture& picture) {
    fromVideo_.run({still_[0], {kLumaSmoothing}},
                   {gpu::sampler(0, picture), gpu::storage(0, words_)}, groupsOf(still_[0]));
    buildCoarse(still_);
}

void LumaPyramids::buildCoarse(const std::vector<LumaLevel>& levels) {
    for (std::size_t i = 1; i < levels.size(); ++i)
        down_.run({levels[i - 1], levels[i]}, {gpu::storage(0, words_)}, groupsOf(levels[i]));
}

}  // namespace mfar
