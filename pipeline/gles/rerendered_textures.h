#pragma once

#include "base/gl/texture.h"
#include "pipeline/warp/rerendered_pictures.h"

namespace mfar {

/// The re-rendered pictures on the GPU, one below the other in one texture. Picture i begins at row
/// i * (height of the layer). colour() is RGBA8. surface() is Rgba32F; its channels are the members
/// of WarpSurface. light() is Rg32UI with LightWords.
class RerenderedTextures {
public:
    explicit RerenderedTextures(Size layer);

    void store(const RerenderedPictures::StoredRows& rows);
    [[nodiscard]] const gpu::Texture& colour() const { return colour_; }
    [[nodiscard]] const gpu::Texture& surface() const { return surface_; }
    [[nodiscard]] const gpu::Texture& light() const { return light_; }
    /// True once rows with light were stored. Pictures stored before have no valid light.
    [[nodiscard]] bool isLit() const { return isLit_; }

private:
    Size layer_;
    gpu::Texture colour_, surface_, light_;
    bool isLit_ = false;
};

}  // namespace mfar
