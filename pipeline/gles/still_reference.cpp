#include "pipeline/gles/still_reference.h"

#include "pipeline/superres/still_scale.h"

namespace mfar {

StillReference::StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture)
    : rig_(stillFor(output, rig)), picture_(picture),
      raised_(rig_.still.size, gpu::TexelFormat::R8, gpu::Filter::Linear), raisedTarget_(raised_),
      raise_("still_raise.frag") {
    if (rig_.still.size != rig.still.size) reducer_.emplace(rig.still.size, rig_.still.size);
}

void StillReference::set(const ImageView& still, const StillTone& tone) {
    if (tone != tone_.tone()) tone_.set(tone);
    picture_.upload(still);
    if (reducer_) reducer_->run(picture_.texture());
    raise_.run({.neighbours = reducer_ ? 0 : kLinearLoss},
               {gpu::sampler(0, picture()), gpu::sampler(1, tone_.texture())}, raisedTarget_);
    picture_.finishReading();
}

}  // namespace mfar
