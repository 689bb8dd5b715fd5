#include "pipeline/warp/paint_pyramid.h"

#include "base/srgb.h"
#include "pipeline/render/paint.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mfar {
namespace {

constexpr float kMost = 255;

using Values = std::array<float, 4>;

Values linearOf(const SurfaceTexture& texture, std::size_t texel) {
    Values out{};
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint8_t byte = texture.texels[texel][c];
        out[c] =
            texture.srgb && c < 3 ? linearOfSrgbByte()[byte] : static_cast<float>(byte) / kMost;
    }
    return out;
}

Values lookedUp(const SurfaceTexture& texture, float u, float v) {
    const auto pair = [](float share, int side, int& first, int& second) {
        const float at = share * static_cast<float>(side) - 0.5F, low = std::floor(at);
        first = (static_cast<int>(low) + side) % side;
        second = (first + 1) % side;
        return at - low;
    };
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    const float right = pair(u, texture.size.width, x0, x1);
    const float below = pair(v, texture.size.height, y0, y1);
    Values out{};
    const auto add = [&](int x, int y, float weight) {
        const Values texel =
            linearOf(texture, static_cast<std::size_t>(y) * texture.size.width + x);
        for (std::size_t c = 0; c < 4; ++c)
            out[c] += weight * texel[c];
    };
    add(x0, y0, (1 - right) * (1 - below));
    add(x1, y0, right * (1 - below));
    add(x0, y1, (1 - right) * below);
    add(x1, y1, right * below);
    return out;
}

std::uint32_t nearestByte(float level) {
    return static_cast<std::uint32_t>(std::lround(level));
}
std::uint32_t rootByte(float linear) {
    return nearestByte(kMost * std::sqrt(linear));
}

std::uint32_t rootsOf(const Eigen::Vector3f& linear) {
    return rootByte(linear[0]) | rootByte(linear[1]) << 8 | rootByte(linear[2]) << 16;
}

/// Converts base colour (three values) and metallic (the fourth value) to paint. The colour is
/// clamped to [0, 1] as in TracedScene, so that a surface never reflects more light than it
/// receives.
PaintWords wordsOf(const Values& base, bool emits) {
    const Eigen::Array3f colour(base[0], base[1], base[2]);
    const Paint paint = paintOf(colour.max(0.0F).min(1.0F), base[3], {}, emits);
    return {rootsOf(paint.diffuse), rootsOf(paint.facing)};
}

void addSquares(std::uint32_t roots, float weight, Eigen::Vector3f& sum) {
    for (int c = 0; c < 3; ++c) {
        const float root = static_cast<float>(roots >> 8 * c & 0xFFU) / kMost;
        sum[c] += weight * root * root;
    }
}

struct Taps {
    int first, count;
    std::array<float, 3> weights;
};

/// A row (or column) of `side` texels is reduced to `halfSide` texels. Returns the texels and
/// weights of the mean that becomes texel `i` of the reduced row.
Taps tapsOf(int i, int side, int halfSide) {
    const float step = static_cast<float>(side) / static_cast<float>(halfSide);
    const float begin = static_cast<float>(i) * step, end = begin + step;
    Taps t{static_cast<int>(begin), 0, {}};
    for (int k = t.first; k < side && t.count < 3; ++k) {
        const float share =
            std::min(end, static_cast<float>(k) + 1) - std::max(begin, static_cast<float>(k));
        if (!(share > 1e-4F)) break;
        t.weights[static_cast<std::size_t>(t.count++)] = share / step;
    }
    return t;
}

/// Computes the next smaller pyramid level. A texel is the mean of 2x2 texels. Along a side of odd
/// length, it is a weighted mean of up to three texels.
PaintPicture halved(const PaintPicture& picture) {
    const Size size = picture.size;
    const Size half{std::max(size.width / 2, 1), std::max(size.height / 2, 1)};
    PaintPicture out{half, {}};
    out.texels.reserve(static_cast<std::size_t>(half.width) * half.height);
    std::vector<Taps> columns;
    for (int x = 0; x < half.width; ++x)
        columns.push_back(tapsOf(x, size.width, half.width));
    for (int y = 0; y < half.height; ++y) {
        const Taps rows = tapsOf(y, size.height, half.height);
        for (int x = 0; x < half.width; ++x) {
            const Taps& c = columns[static_cast<std::size_t>(x)];
            Eigen::Vector3f diffuse{0, 0, 0}, facing{0, 0, 0};
            for (int j = 0; j < rows.count; ++j)
                for (int i = 0; i < c.count; ++i) {
                    const PaintWords& t =
                        picture.texels[static_cast<std::size_t>(rows.first + j) * size.width +
                                       c.first + i];
                    const float weight = rows.weights[static_cast<std::size_t>(j)] *
                                         c.weights[static_cast<std::size_t>(i)];
                    addSquares(t.diffuse, weight, diffuse);
                    addSquares(t.facing, weight, facing);
                }
            out.texels.push_back({rootsOf(diffuse), rootsOf(facing)});
        }
    }
    return out;
}

PaintPicture largestOf(const PaintSource& source, Size size) {
    PaintPicture out{size, {}};
    out.texels.resize(static_cast<std::size_t>(size.width) * size.height);
    for (std::size_t i = 0; i < out.texels.size(); ++i) {
        const std::size_t row = i / size.width;
        const auto x = static_cast<float>(i % size.width), y = static_cast<float>(row);
        const float u = (x + 0.5F) / static_cast<float>(size.width);
        const float v = (y + 0.5F) / static_cast<float>(size.height);
        const auto valueOf = [&](const SurfaceTexture& texture) {
            return texture.size == size ? linearOf(texture, i) : lookedUp(texture, u, v);
        };
        Values base = source.factor;
        if (source.colour != nullptr) {
            const Values t = valueOf(*source.colour);
            for (std::size_t c = 0; c < 3; ++c)
                base[c] *= t[c];
        }
        if (source.metallic != nullptr) base[3] *= valueOf(*source.metallic)[2];
        out.texels[i] = wordsOf(base, source.emits);
    }
    return out;
}

}  // namespace

PaintSource paintSourceOf(const SilhouetteModels::Part& part) {
    const Material& m = *part.material;
    return {part.baseColour,
            part.metallicRoughness,
            {m.baseColour.x(), m.baseColour.y(), m.baseColour.z(), m.metallic},
            m.emits()};
}

std::vector<PaintPicture> paintPyramid(const PaintSource& source, int longestSide) {
    Size size{1, 1};
    for (const SurfaceTexture* texture : {source.colour, source.metallic})
        if (texture != nullptr)
            size = {std::min(std::max(size.width, texture->size.width), longestSide),
                    std::min(std::max(size.height, texture->size.height), longestSide)};
    std::vector<PaintPicture> out{largestOf(source, size)};
    while (out.back().texels.size() > 1)
        out.push_back(halved(out.back()));
    return out;
}

}  // namespace mfar
