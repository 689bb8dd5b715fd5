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

/// The newest still, and what is computed from it once: a reduced picture and its luma. If the
/// output has a much lower resolution than the still, the picture and the luma are reduced to the
/// resolution that the output can use.
class StillReference {
public:
    /// `output`: size of the output picture, which shows the whole video picture. `picture`: the
    /// texture into which stills are uploaded. It must have a linear filter and must outlive this
    /// object.
    StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture);

    /// Uploads a still and computes the other pictures from it. The still must have the still
    /// camera's size. Its pixel format may change from one still to the next. `tone` is applied to
    /// raised().
    void set(const ImageView& still, const StillTone& tone = {});

    /// The rig whose still camera has picture()'s resolution. The lens is the same, but there may
    /// be fewer pixels.
    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    /// The still as the camera delivered it.
    [[nodiscard]] const gpu::Texture& whole() const { return picture_.texture(); }
    [[nodiscard]] const gpu::Texture& picture() const {
        return reducer_ ? reducer_->picture() : picture_.texture();
    }
    /// Luma with the size of rig().still; R8, linear filter. Unless the still was reduced, its
    /// finest detail is amplified, which compensates the loss of detail in a linear look-up.
    [[nodiscard]] const gpu::Texture& raised() const { return raised_; }
    [[nodiscard]] const ToneTexture& tone() const { return tone_; }

private:
    StereoRig rig_;
    gpu::PictureTexture& picture_;
    std::optional<StillReducer> reducer_;
    ToneTexture tone_;
    gpu::Texture raised_;
    gpu::Framebuffer raisedTarget_;
    gpu::DrawPass<params::RaiseStill> raise_;
};

}  // namespace mfar
