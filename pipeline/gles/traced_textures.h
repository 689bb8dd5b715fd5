#pragma once

#include "base/gl/texture.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/warp/traced_picture.h"

#include <optional>

namespace mfar {

/// Rg32F texture with the normalised ray (x/z, y/z) of each pixel.
[[nodiscard]] gpu::Texture rayTexture(const CameraModel& camera);

/// The members of a TracedPicture as textures: picture() is RGBA8, depth() is R32F, colour() is
/// RGBA8, surface() is Rgba32F, packed() is R32UI, light() and gloss() are Rg32UI.
class TracedTextures {
public:
    void upload(const TracedPicture& traced);

    /// Must be called only after the first upload.
    [[nodiscard]] const LensProjection& lens() const { return *lens_; }
    [[nodiscard]] const gpu::Texture& picture() const { return picture_; }
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }
    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }
    [[nodiscard]] const gpu::Texture& surface() const { return surface_; }
    [[nodiscard]] const gpu::Texture& packed() const { return packed_; }
    /// light() is valid only if TracedPicture::light is not empty, and gloss() only if
    /// TracedPicture::gloss is not empty.
    [[nodiscard]] const gpu::Texture& light() const { return light_; }
    [[nodiscard]] const gpu::Texture& gloss() const { return gloss_; }

private:
    std::optional<LensProjection> lens_;
    gpu::Texture picture_, depth_, colour_, surface_, packed_, light_, gloss_;
};

}  // namespace mfar
