#pragma once

#include "base/gl/texture.h"
#include "pipeline/warp/paint_pyramid.h"

#include <map>
#include <memory>

namespace mfar::gles {

/// A part's paint (see PaintWords): repeating sRGB textures with all mipmap levels.
struct PaintTextures {
    /// Pictures that are larger than the GPU's largest texture are reduced to that size.
    explicit PaintTextures(const PaintSource& source);

    gpu::Texture diffuse, facing;
};

/// Paint textures by their source. Parts with equal sources share textures.
class PaintStore {
public:
    [[nodiscard]] std::shared_ptr<const PaintTextures> of(const PaintSource& source);

private:
    // Textures live as long as a part that uses them. Such a part also keeps the source's pictures
    // alive, so that no other picture gets their address.
    std::map<PaintSource, std::weak_ptr<const PaintTextures>> textures_;
};

}  // namespace mfar::gles
