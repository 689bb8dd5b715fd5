#pragma once

#include "pipeline/geometry.h"
#include "pipeline/gpu/pass.h"
#include "pipeline/gpu/picture_texture.h"

#include <cstdint>

namespace mfar {

/// The newest still and everything about it that is computed once: its picture and what it shows
/// beyond the video's resolution, detail = luma - up(down(luma)), on its own pixel grid.
class StillReference {
public:
    explicit StillReference(const StereoRig& rig);

    /// Size must be the still camera's; the pixel format may change from one still to the next.
    void set(const ImageView& still);

    [[nodiscard]] const gpu::Texture& picture() const { return picture_.texture(); }
    [[nodiscard]] const gpu::Texture& detail() const { return detail_; }  ///< R8, 128 = none

private:
    struct LowParams {
        float step[4];
    };
    struct DetailParams {
        std::int32_t low[4];
        float scale[4];
    };

    gpu::PictureTexture picture_{gpu::Filter::Linear};
    gpu::Texture low_, detail_;
    gpu::Framebuffer lowTarget_, detailTarget_;
    gpu::DrawPass<LowParams> lowPass_;
    gpu::DrawPass<DetailParams> detailPass_;
};

}  // namespace mfar
