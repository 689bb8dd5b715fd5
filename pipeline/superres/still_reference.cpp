#include "pipeline/superres/still_reference.h"

#include "pipeline/plan/still_scale.h"

namespace mfar {

StillReference::StillReference(const StereoRig& rig, Size output)
    : rig_(withStillReduced(rig, output)), picture_(gpu::Filter::Linear),
      low_(stillSizeAtVideoScale(rig_), gpu::TexelFormat::R8),
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
    constexpr float kTaps = 0.25 * kStillFootprint;
    l.step[2] = kTaps * l.step[0];
    l.step[3] = kTaps * l.step[1];
    lowPass_.run(l, {gpu::sampler(0, picture())}, lowTarget_);
    DetailParams d{};
    d.low[0] = low.width;
    d.low[1] = low.height;
    d.scale[0] = static_cast<float>(low.width) / static_cast<float>(full.width);
    d.scale[1] = static_cast<float>(low.height) / static_cast<float>(full.height);
    d.scale[2] = reducer_ ? 0 : static_cast<float>(kStillNeighbours);
    detailPass_.run(d, {gpu::sampler(0, picture()), gpu::sampler(1, low_)}, detailTarget_);
    picture_.finishReading();
}

}  // namespace mfar
