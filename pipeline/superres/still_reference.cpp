#include "pipeline/superres/still_reference.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Width of what a video pixel sees, in its pitch; see still_low.frag.
constexpr float kFootprint = 1.25F;

// The still's pixel grid at the scale of the video: as many pixels as the video would need for it.
Size lowSize(const StereoRig& rig) {
    const auto scaled = [](int pixels, double ratio) {
        return std::max(8, static_cast<int>(std::lround(pixels * std::min(ratio, 1.0))));
    };
    return {scaled(rig.still.size.width, rig.video.fx / rig.still.fx),
            scaled(rig.still.size.height, rig.video.fy / rig.still.fy)};
}

}  // namespace

StillReference::StillReference(const StereoRig& rig)
    : low_(lowSize(rig), gpu::TexelFormat::R8),
      detail_(rig.still.size, gpu::TexelFormat::R8, gpu::Filter::Linear), lowTarget_(low_),
      detailTarget_(detail_), lowPass_("still_low.frag"), detailPass_("still_detail.frag") {}

void StillReference::set(const ImageView& still) {
    picture_.upload(still);
    const auto low = low_.size();
    const auto full = picture().size();
    LowParams l{};
    l.step[0] = 1.0F / static_cast<float>(low.width);
    l.step[1] = 1.0F / static_cast<float>(low.height);
    l.step[2] = 0.25F * kFootprint * l.step[0];
    l.step[3] = 0.25F * kFootprint * l.step[1];
    lowPass_.run(l, {gpu::sampler(0, picture())}, lowTarget_);
    DetailParams d{};
    d.low[0] = low.width;
    d.low[1] = low.height;
    d.scale[0] = static_cast<float>(low.width) / static_cast<float>(full.width);
    d.scale[1] = static_cast<float>(low.height) / static_cast<float>(full.height);
    detailPass_.run(d, {gpu::sampler(0, picture()), gpu::sampler(1, low_)}, detailTarget_);
}

}  // namespace mfar
