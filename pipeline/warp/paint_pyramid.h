#pragma once

#include "base/paint_words.h"
#include "pipeline/warp/silhouette_models.h"

#include <array>
#include <compare>
#include <vector>

namespace mfar {

/// The textures and factors that determine the paint of one part of a model. Parts with equal
/// sources have the same paint.
struct PaintSource {
    const SurfaceTexture *colour = nullptr, *metallic = nullptr;
    std::array<float, 4> factor{};  ///< base colour and metallic
    bool emits = false;             ///< true if the material emits light

    auto operator<=>(const PaintSource&) const = default;
};
/// The part must have a material.
[[nodiscard]] PaintSource paintSourceOf(const SilhouetteModels::Part& part);

/// One level of a pyramid, row-major. The bytes of its words are 255 times the square root of
/// linear values, so that sums of squared bytes are sums of linear values.
struct PaintPicture {
    Size size;
    std::vector<PaintWords> texels;
};
/// Combines a material's textures of base colour and metallic into one picture. Its width is that
/// of the wider texture, its height that of the higher texture, both limited to `longestSide`
/// texels. Returns it and all smaller pyramid levels down to one texel, largest first. Takes 4 ns
/// per texel.
[[nodiscard]] std::vector<PaintPicture> paintPyramid(const PaintSource& source, int longestSide);

}  // namespace mfar
