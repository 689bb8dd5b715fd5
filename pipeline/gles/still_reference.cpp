#include "pipeline/gles/still_reference.h"

#include "pipeline/superres/still_scale.h"

namespace mfar {

StillReference::StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture)
    : rig_(stillFor(output, rig)), picture_(picture), low_(lowSizeOf(rig_), gpu::TexelFormat::R8),
      detail_(rig_.still.size, gpu::TexelFormat::R8, gpu::Filter::Linear), lowTarget_(low_),
      detailTarget_(detail_), lowPass_("still_low.frag"), detailPass_("still_detail.frag") {
    if (rig_.still.size != rig.still.size) reducer_.emplace(rig.still.size, rig_.still.size);
}

void StillReference::set(const ImageView& still) {
    picture_.upload(still);
    if (reducer_) reducer_->run(picture_.texture());
    const auto low = low_.size();
    const auto full = picture().size();
    params::StillLow l{};
    l.texelX = 1.0F / static_cast<float>(low.width);
    l.texelY = 1.0F / static_cast<float>(low.height);
    l.tapX = 0.25F * kFootprint * l.texelX;
    l.tapY = 0.25F * kFootprint * l.texelY;
    lowPass_.run(l, {gpu::sampler(0, picture())}, lowTarget_);
    detailPass_.run({.lowWidth = low.width,
                     .lowHeight = low.height,
                     .scaleX = static_cast<float>(low.width) / static_cast<float>(full.width),
                     .scaleY = static_cast<float>(low.height) / static_cast<float>(full.height),
                     .neighbours = reducer_ ? 0 : kLinearLoss},
                    {gpu::sampler(0, picture()), gpu::sampler(1, low_)}, detailTarget_);
    picture_.finishReading();
}

}  // namespace mfar
