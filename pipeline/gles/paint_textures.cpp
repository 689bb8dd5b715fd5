#include "pipeline/gles/paint_textures.h"

#include "base/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace mfar::gles {
namespace {

using Texel = std::array<std::uint8_t, 4>;

/// Returns a table that converts bytes of PaintPicture (square roots of linear values) to sRGB
/// bytes.
const std::array<std::uint8_t, 256>& srgbOfRoot() {
    static const auto kBytes = [] {
        std::array<std::uint8_t, 256> out{};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const float root = static_cast<float>(i) / 255;
            out[i] = static_cast<std::uint8_t>(std::lround(255 * srgbEncoded(root * root)));
        }
        return out;
    }();
    return kBytes;
}

Texel texelOf(std::uint32_t word) {
    const auto& bytes = srgbOfRoot();
    return {bytes[word & 0xFFU], bytes[word >> 8 & 0xFFU], bytes[word >> 16 & 0xFFU], 255};
}

gpu::Texture textureOf(const std::vector<PaintPicture>& pyramid, std::uint32_t PaintWords::* part) {
    const std::vector<PaintWords>& all = pyramid.front().texels;
    const bool isUniform = std::ranges::all_of(
        all, [&](const PaintWords& words) { return words.*part == all.front().*part; });
    const auto levels = std::span(pyramid).last(isUniform ? 1 : pyramid.size());
    gpu::Texture out(levels.front().size, gpu::TexelFormat::Srgb8Alpha8, gpu::Filter::Linear,
                     static_cast<int>(levels.size()));
    std::vector<Texel> texels;
    int level = 0;
    for (const PaintPicture& picture : levels) {
        texels.clear();
        for (const PaintWords& words : picture.texels)
            texels.push_back(texelOf(words.*part));
        out.uploadLevel(level++, picture.size, texels);
    }
    out.repeat();
    return out;
}

}  // namespace

PaintTextures::PaintTextures(const PaintSource& source) {
    const std::vector<PaintPicture> pyramid = paintPyramid(source, gpu::largestTexture());
    diffuse = textureOf(pyramid, &PaintWords::diffuse);
    facing = textureOf(pyramid, &PaintWords::facing);
}

std::shared_ptr<const PaintTextures> PaintStore::of(const PaintSource& source) {
    std::weak_ptr<const PaintTextures>& known = textures_[source];
    std::shared_ptr<const PaintTextures> out = known.lock();
    if (out) return out;
    out = std::make_shared<const PaintTextures>(source);
    known = out;
    std::erase_if(textures_, [](const auto& entry) { return entry.second.expired(); });
    return out;
}

}  // namespace mfar::gles
