#pragma once

#include "base/gl/texture.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/warp/traced_picture.h"

#include <optional>

namespace mfar {

/// Rg32F texture with the normalised ray (x/z, y/z) of each pixel.
[[nodiscard]] gpu::Texture rayTexture(const CameraModel& camera);

/// The traced picture that is warped, as textures. See TracedPicture for their contents.
class TracedTextures {
public:
    void upload(const TracedPicture& traced);

    /// Must be called only after the first upload.
    [[nodiscard]] const LensProjection& lens() const { return *lens_; }
    [[nodiscard]] const gpu::Texture& picture() const { return picture_; }  ///< RGBA8, as traced
    [[nodiscard]] const gpu::Texture& depth() const { return depth_; }      ///< R32F, as traced
    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }    ///< RGBA8
    [[nodiscard]] const gpu::Texture& surface() const { return surface_; }  ///< Rgba32F
    [[nodiscard]] const gpu::Texture& packed() const { return packed_; }    ///< R32UI

private:
    std::optional<LensProjection> lens_;
    gpu::Texture picture_, depth_, colour_, surface_, packed_;
};

}  // namespace mfar
