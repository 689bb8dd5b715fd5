#pragma once

#include "pipeline/gpu/pass.h"
#include "pipeline/gpu/texture.h"

#include <array>
#include <optional>

namespace mfar::gpu {

/// The picture that is uploaded again and again, whatever its pixel format: grey and RGBA as they
/// are, BGRA by the texture's swizzle, Y U V as planes that one draw turns into RGBA8. Allocates
/// when size or format change. Needs a current context for its whole life.
class PictureTexture {
public:
    /// `filter` of texture().
    explicit PictureTexture(Filter filter = Filter::Nearest) : filter_(filter) {}

    /// The view is sound (requireSound()). Leaves another framebuffer bound than it found.
    void upload(const ImageView& view);

    /// As of the last upload: R8 for grey, otherwise RGBA8. Samples as R G B.
    [[nodiscard]] const Texture& texture() const { return picture_; }

private:
    struct Params {
        float rows[3][4];
        float step[4];
    };
    /// What pictures in Y U V need on their way.
    struct Planes {
        std::array<Texture, 3> textures;  // as many as the format has planes
        Framebuffer target;
        DrawPass<Params> pass;
    };

    void allocate(const ImageView& view);
    void convert(const ImageView& view);

    Filter filter_;
    Size size_;
    PixelFormat format_ = PixelFormat::Rgba8;
    Texture picture_;
    std::optional<Planes> planes_;
};

}  // namespace mfar::gpu
