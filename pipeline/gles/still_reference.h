#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/still.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/gles/still_reducer.h"
#include "pipeline/gles/tone_texture.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Stores the newest still as a picture and as luma, both computed once per still. Picture and luma
/// are reduced if the output has a much lower resolution than the still.
class StillReference {
public:
    /// `output` is the size of the output picture, which shows the whole video picture. Stills are
    /// uploaded into `picture`, which must have a linear filter and outlive this object.
    StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture);

    /// Uploads a still of the still camera's size. Its pixel format may change from one still to
    /// the next. `tone` is applied to raised(). `noise`: standard deviation of the noise [grey
    /// levels] that is removed from raised().
    void set(const ImageView& still, const StillTone& tone = {}, double noise = 0);

    /// The rig, but with a still camera of the resolution of picture().
    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    [[nodiscard]] const gpu::Texture& whole() const { return picture_.texture(); }
    [[nodiscard]] const gpu::Texture& picture() const {
        return reducer_ ? reducer_->picture() : picture_.texture();
    }
    /// Luma with the size of rig().still; R8, linear filter. If the still was not reduced, its
    /// finest detail is amplified to compensate for the loss in linear look-ups.
    [[nodiscard]] const gpu::Texture& raised() const { return raised_; }
    [[nodiscard]] const ToneTexture& tone() const { return tone_; }

private:
    StereoRig rig_;
    gpu::PictureTexture& picture_;
    std::optional<StillReducer> reducer_;
    ToneTexture tone_;
    gpu::Texture quiet_, raised_;
    gpu::Framebuffer quietTarget_, raisedTarget_;
    gpu::DrawPass<params::QuietStill> removeNoise_;
    gpu::DrawPass<params::RaiseStill> raise_, raiseQuiet_;
};

}  // namespace mfar
