#pragma once

#include "base/geometry.h"
#include "base/gl/pass.h"
#include "pipeline/engine/params/still.h"
#include "pipeline/gles/picture_texture.h"
#include "pipeline/gles/still_reducer.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// The newest still and everything about it that is computed once: its picture and what it shows
/// beyond the video's resolution, detail = luma - up(down(luma)), on its own pixel grid. Where the
/// output shows the still's pixels smaller than its own, the still is reduced to the output's.
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
    [[nodiscard]] const gpu::Texture& detail() const { return detail_; }  ///< R8, 128 = none

private:
    StereoRig rig_;
    gpu::PictureTexture& picture_;
    std::optional<StillReducer> reducer_;
    gpu::Texture low_, detail_;
    gpu::Framebuffer lowTarget_, detailTarget_;
    gpu::DrawPass<params::StillLow> lowPass_;
    gpu::DrawPass<params::StillDetail> detailPass_;
};

}  // namespace mfar
