#include "pipeline/render/texture_lookup.h"

#include "base/srgb.h"

#include <array>
#include <cmath>

namespace mfar {
namespace {

constexpr float kTexelSteps = 255;

Eigen::Vector4f linearTexel(const SurfaceTexture& texture, int column, int row) {
    const auto& t =
        texture
            .texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.size.width) +
                    static_cast<std::size_t>(column)];
    if (!texture.srgb) return Eigen::Vector4f(t[0], t[1], t[2], t[3]) / kTexelSteps;
    const auto& decoded = linearOfSrgbByte();
    return {decoded[t[0]], decoded[t[1]], decoded[t[2]], static_cast<float>(t[3]) / kTexelSteps};
}

struct TexelPair {
    int first, second;
    float share;
};

TexelPair texelsAbout(float coordinate, int count) {
    const float x = (coordinate - std::floor(coordinate)) * static_cast<float>(count) - 0.5F;
    const float below = std::floor(x);
    const int first = static_cast<int>(below);
    return {first < 0 ? count - 1 : std::min(first, count - 1), first + 1 >= count ? 0 : first + 1,
            x - below};
}

}  // namespace

Eigen::Vector4f lookUp(const SurfaceTexture& texture, const Eigen::Vector2f& uv) {
    const TexelPair x = texelsAbout(uv.x(), texture.size.width);
    const TexelPair y = texelsAbout(uv.y(), texture.size.height);
    const Eigen::Vector4f top = linearTexel(texture, x.first, y.first) * (1 - x.share) +
                                linearTexel(texture, x.second, y.first) * x.share;
    const Eigen::Vector4f bottom = linearTexel(texture, x.first, y.second) * (1 - x.share) +
                                   linearTexel(texture, x.second, y.second) * x.share;
    return top * (1 - y.share) + bottom * y.share;
}

}  // namespace mfar
