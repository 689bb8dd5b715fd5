#include "pipeline/superres/still_reference.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// Width of what a video pixel sees, in its pitch; see still_low.frag.
constexpr float kFootprint = 1.25F;

// Neighbours' share that makes up for the linear filter; see still_detail.frag.
constexpr float kLost = 0.08F;

// Pixels of a reduced still per pixel of the output: its detail is read between its pixels, which
// would cost what is finest (measured on photographs: +0.2 to +0.9 dB over 1; 1.8 is no better).
constexpr double kFiner = 1.4;
// Stills that would lose less than this in each direction stay as they are: hardly anything
// aliases, and resampling blurs.
constexpr double kWorthReducing = 0.9;

// The still with no more pixels than the output has a use for.
StereoRig reducedTo(Size output, StereoRig rig) {
    const double x = kFiner * output.width * rig.video.fx / (rig.video.size.width * rig.still.fx);
    const double y = kFiner * output.height * rig.video.fy / (rig.video.size.height * rig.still.fy);
    if (std::max(x, y) < kWorthReducing) {
        const auto scaled = [](int pixels, double by) {
            return std::max(1, static_cast<int>(std::lround(pixels * by)));
        };
        rig.still =
            rig.still.scaledTo({scaled(rig.still.size.width, x), scaled(rig.still.size.height, y)});
    }
    return rig;
}

// The still's pixel grid at the scale of the video: as many pixels as the video would need for it.
Size lowSize(const StereoRig& rig) {
    const auto scaled = [](int pixels, double ratio) {
        return std::max(8, static_cast<int>(std::lround(pixels * std::min(ratio, 1.0))));
    };
    return {scaled(rig.still.size.width, rig.video.fx / rig.still.fx),
            scaled(rig.still.size.height, rig.video.fy / rig.still.fy)};
}

}  // namespace

StillReference::StillReference(const StereoRig& rig, Size output)
    : rig_(reducedTo(output, rig)), picture_(gpu::Filter::Linear),
      low_(lowSize(rig_), gpu::TexelFormat::R8),
      detail_(rig_.still.size, gpu::TexelFormat::R8, gpu::Filter::Linear), lowTarget_(low_),
      detailTarget_(detail_), lowPass_("still_low.frag"), detailPass_("still_detail.frag") {
    if (rig_.still.size != rig.still.size) reducer_.emplace(rig.still.size, rig_.still.size);
}

void StillReference::set(const ImageView& still) {
    picture_.upload(still);
    if (reducer_) reducer_->run(picture_.texture());
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
    d.scale[2] = reducer_ ? 0 : kLost;
    detailPass_.run(d, {gpu::sampler(0, picture()), gpu::sampler(1, low_)}, detailTarget_);
    picture_.finishReading();
}

}  // namespace mfar
