#pragma once

#include "base/gl/texture.h"
#include "pipeline/warp/paint_pyramid.h"

#include <map>
#include <memory>

namespace mfar::gles {

/// The paint of one part of a model (see PaintWords): repeating sRGB textures with all mipmap
/// levels. A texture has only one texel if its paint is the same everywhere. For example, `facing`
/// is uniform for a part without metal, and `diffuse` for a part of pure metal.
struct PaintTextures {
    /// Pictures that are larger than the GPU's largest texture are reduced to that size.
    explicit PaintTextures(const PaintSource& source);

    gpu::Texture diffuse, facing;
};

/// Finds the paint textures of a part by its source. Parts with equal sources share textures.
class PaintStore {
public:
    [[nodiscard]] std::shared_ptr<const PaintTextures> of(const PaintSource& source);

private:
    // Textures live as long as a part of a model uses them. The key contains addresses of pictures.
    // The part keeps these pictures alive, so that no other picture gets the same address.
    std::map<PaintSource, std::weak_ptr<const PaintTextures>> textures_;
};

}  // namespace mfar::gles
