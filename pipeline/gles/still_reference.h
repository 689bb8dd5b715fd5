#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/still.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/gles/still_reducer.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// The newest still and everything that is computed once from it: its picture and its luma. If the
/// output shows the still's pixels smaller than its own, both are reduced to the output's
/// resolution.
class StillReference {
public:
    /// `output`: size of the output for the video's whole picture. `picture` holds the stills; it
    /// has a linear filter and must outlive this.
    StillReference(const StereoRig& rig, Size output, gpu::PictureTexture& picture);

    /// Size must be the still camera's; the pixel format may change from one still to the next.
    void set(const ImageView& still);

    /// The rig with the still camera at picture()'s resolution: the same lens, possibly fewer
    /// pixels.
    [[nodiscard]] const StereoRig& rig() const { return rig_; }
    /// The picture as delivered.
    [[nodiscard]] const gpu::Texture& whole() const { return picture_.texture(); }
    [[nodiscard]] const gpu::Texture& picture() const {
        return reducer_ ? reducer_->picture() : picture_.texture();
    }
    /// Luma of rig().still's size. Unless it was reduced, its finest detail is raised to compensate
    /// the loss in a linear look-up. R8, linear filter.
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
