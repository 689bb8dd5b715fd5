#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/still.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/gles/still_reducer.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// The newest still and everything about it that is computed once: its picture and its luma. Where
/// the output shows the still's pixels smaller than its own, both are reduced to the output's.
class StillReference {
public:
    /// `output`: size of what is made of the video's whole picture. `picture` takes the stills; it
    /// has a linear filter and must outlive this.
    StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture);

    /// Size must be the still camera's; the pixel format may change from one still to the next.
    void set(const ImageView& still);

    /// The rig with the still camera as picture() has it: the same lens, maybe fewer pixels.
    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    /// The picture as it came.
    [[nodiscard]] const gpu::Texture& whole() const { return picture_.texture(); }
    [[nodiscard]] const gpu::Texture& picture() const {
        return reducer_ ? reducer_->picture() : picture_.texture();
    }
    /// Luma of rig().still's size. Unless it was reduced, its finest detail is raised by what a
    /// linear look-up takes from it. R8, linear filter.
    [[nodiscard]] const gpu::Texture& raised() const { return raised_; }

private:
    StereoRig rig_;
    gpu::PictureTexture& picture_;
    std::optional<StillReducer> reducer_;
    gpu::Texture raised_;
    gpu::Framebuffer raisedTarget_;
    gpu::DrawPass<params::RaiseStill> raise_;
};

}  // namespace mfar
