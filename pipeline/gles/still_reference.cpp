#include "pipeline/gles/still_reference.h"

#include "pipeline/superres/still_scale.h"

namespace mfar {

StillReference::StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture)
    : rig_(stillFor(output, rig)), picture_(picture), quiet_(rig_.still.size, gpu::TexelFormat::R8),
      raised_(rig_.still.size, gpu::TexelFormat::R8, gpu::Filter::Linear), quietTarget_(quiet_),
      raisedTarget_(raised_), removeNoise_("still_quiet.frag"), raise_("still_raise.frag"),
      raiseQuiet_("still_raise.frag", "#define LUMA\n") {
    if (rig_.still.size != rig.still.size) reducer_.emplace(rig.still.size, rig_.still.size);
}

void StillReference::set(const ImageView& still, const StillTone& tone, double noise) {
    if (tone != tone_.tone()) tone_.set(tone);
    picture_.upload(still);
    if (reducer_) reducer_->run(picture_.texture());
    const float quiet = quietVariance(noise, still.size, rig_.still.size);
    const bool isNoisy = quiet > 0;
    if (isNoisy)
        removeNoise_.run({.noise = quiet / (255 * 255)}, {gpu::sampler(0, picture())},
                         quietTarget_);
    (isNoisy ? raiseQuiet_ : raise_)
        .run({.neighbours = reducer_ ? 0 : kLinearLoss},
             {gpu::sampler(0, isNoisy ? quiet_ : picture()), gpu::sampler(1, tone_.texture())},
             raisedTarget_);
    picture_.finishReading();
}

}  // namespace mfar
