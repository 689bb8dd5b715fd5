#include "pipeline/simd/paint_textures.h"

#include "base/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kLargestSide = 0x8000;  // texels; a side has 16 bits
constexpr float kMost = 255;

using Values = std::array<float, 4>;  // linear, [0, 1]

/// As texture_lookup.h has it.
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
        const auto& texel = texture.texels[static_cast<std::size_t>(y) * texture.size.width + x];
        for (std::size_t c = 0; c < 4; ++c)
            out[c] += weight * (texture.srgb && c < 3 ? linearOfSrgbByte()[texel[c]]
                                                      : static_cast<float>(texel[c]) / kMost);
    };
    add(x0, y0, (1 - right) * (1 - below));
    add(x1, y0, right * (1 - below));
    add(x0, y1, (1 - right) * below);
    add(x1, y1, right * below);
    return out;
}

std::uint32_t nearestByte(float level) {
    return static_cast<std::uint32_t>(level + 0.5F);
}
std::uint32_t rootByte(float linear) {
    return nearestByte(kMost * std::sqrt(linear));
}

/// What each byte of a texture becomes.
using Bytes = std::array<std::uint32_t, 256>;
Bytes bytesBy(const auto& value) {
    Bytes out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = value(i);
    return out;
}
Bytes rootBytes(bool srgb) {
    return bytesBy([srgb](std::size_t i) {
        return rootByte(srgb ? linearOfSrgbByte()[i] : static_cast<float>(i) / kMost);
    });
}
Bytes metallicBytes(bool srgb) {
    return bytesBy([srgb](std::size_t i) {
        return srgb ? nearestByte(kMost * linearOfSrgbByte()[i]) : static_cast<std::uint32_t>(i);
    });
}

void fillColours(std::span<std::uint32_t> out, Size size, const SurfaceTexture& from) {
    if (from.size == size) {
        const Bytes bytes = rootBytes(from.srgb);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto& t = from.texels[i];
            out[i] = bytes[t[0]] | bytes[t[1]] << 8 | bytes[t[2]] << 16 | (out[i] & 0xFF000000U);
        }
        return;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto x = static_cast<float>(i % size.width), y = static_cast<float>(i / size.width);
        const Values t = lookedUp(from, (x + 0.5F) / static_cast<float>(size.width),
                                  (y + 0.5F) / static_cast<float>(size.height));
        out[i] =
            rootByte(t[0]) | rootByte(t[1]) << 8 | rootByte(t[2]) << 16 | (out[i] & 0xFF000000U);
    }
}

void fillMetallic(std::span<std::uint32_t> out, Size size, const SurfaceTexture& from) {
    if (from.size == size) {
        const Bytes bytes = metallicBytes(from.srgb);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = (out[i] & 0x00FFFFFFU) | bytes[from.texels[i][2]] << 24;
        return;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto x = static_cast<float>(i % size.width), y = static_cast<float>(i / size.width);
        const Values t = lookedUp(from, (x + 0.5F) / static_cast<float>(size.width),
                                  (y + 0.5F) / static_cast<float>(size.height));
        out[i] = (out[i] & 0x00FFFFFFU) | nearestByte(kMost * t[2]) << 24;
    }
}

/// Means of two by two texels; of an odd side the middle three are drawn together into one.
void halve(const std::uint32_t* from, Size size, std::uint32_t* out, Size half) {
    struct Taps {
        int first, count;
        std::array<float, 3> weights;
    };
    // Each texel of the half reaches over side / half of the whole's.
    const auto taps = [](int i, int side, int halfSide) {
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
    };
    std::vector<Taps> columns;
    for (int x = 0; x < half.width; ++x)
        columns.push_back(taps(x, size.width, half.width));
    for (int y = 0; y < half.height; ++y) {
        const Taps rows = taps(y, size.height, half.height);
        for (int x = 0; x < half.width; ++x) {
            const Taps& c = columns[static_cast<std::size_t>(x)];
            Values sum{};
            for (int j = 0; j < rows.count; ++j)
                for (int i = 0; i < c.count; ++i) {
                    const std::uint32_t t =
                        from[static_cast<std::ptrdiff_t>(rows.first + j) * size.width + c.first +
                             i];
                    const float weight = rows.weights[static_cast<std::size_t>(j)] *
                                         c.weights[static_cast<std::size_t>(i)];
                    for (std::size_t k = 0; k < 3; ++k) {
                        const auto root = static_cast<float>(t >> 8 * k & 0xFFU);
                        sum[k] += weight * root * root;
                    }
                    sum[3] += weight * static_cast<float>(t >> 24);
                }
            out[static_cast<std::ptrdiff_t>(y) * half.width + x] =
                nearestByte(std::sqrt(sum[0])) | nearestByte(std::sqrt(sum[1])) << 8 |
                nearestByte(std::sqrt(sum[2])) << 16 | nearestByte(sum[3]) << 24;
        }
    }
}

Size halfOf(Size size) {
    return {std::max(size.width / 2, 1), std::max(size.height / 2, 1)};
}
std::size_t texelsOf(Size size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}
Size sizeOf(const PaintLevel& level) {
    return {static_cast<int>(level.size & 0xFFFFU), static_cast<int>(level.size >> 16)};
}

using Factor = std::array<float, 4>;
Factor factorOf(const Material& m) {
    return {m.baseColour.x(), m.baseColour.y(), m.baseColour.z(), m.metallic};
}

}  // namespace

PaintTextures::Textures PaintTextures::texturesOf(const SilhouetteModels::Part& part) {
    return {part.baseColour, part.metallicRoughness};
}

void PaintTextures::addPicture(Picture& picture, const Textures& textures) {
    Size size{1, 1};
    for (const SurfaceTexture* texture : {textures.first, textures.second})
        if (texture != nullptr)
            size = {std::min(std::max(size.width, texture->size.width), kLargestSide),
                    std::min(std::max(size.height, texture->size.height), kLargestSide)};
    picture.levels.clear();
    for (Size level = size;; level = halfOf(level)) {
        const std::size_t first = texels_.size();
        picture.levels.push_back({static_cast<std::uint32_t>(first),
                                  static_cast<std::uint32_t>(level.width | level.height << 16)});
        texels_.resize(first + texelsOf(level), 0xFFFFFFFFU);
        const std::span<std::uint32_t> out(texels_.data() + first, texelsOf(level));
        if (picture.levels.size() > 1) {
            const PaintLevel& finer = picture.levels[picture.levels.size() - 2];
            halve(texels_.data() + finer.first, sizeOf(finer), out.data(), level);
        } else {
            if (textures.first != nullptr) fillColours(out, size, *textures.first);
            if (textures.second != nullptr) fillMetallic(out, size, *textures.second);
        }
        if (texelsOf(level) == 1) break;
    }
}

void PaintTextures::setPictures(std::span<const SilhouetteModels::Object> objects) {
    Pictures now;
    for (const SilhouetteModels::Object& object : objects)
        for (const SilhouetteModels::Part& part : object.shape->parts)
            now.try_emplace(texturesOf(part), Picture{object.shape->model, {}});
    const auto isKept = [this](const auto& entry) { return pictures_.contains(entry.first); };
    if (now.size() == pictures_.size() && std::ranges::all_of(now, isKept)) return;
    const Pictures before = std::exchange(pictures_, std::move(now));
    const std::vector<std::uint32_t> texels = std::exchange(texels_, {});
    for (auto& [textures, picture] : pictures_) {
        if (const auto kept = before.find(textures); kept != before.end()) {
            picture = kept->second;
            for (PaintLevel& level : picture.levels) {
                const auto from = texels.begin() + level.first;
                level.first = static_cast<std::uint32_t>(texels_.size());
                texels_.insert(texels_.end(), from,
                               from + static_cast<std::ptrdiff_t>(texelsOf(sizeOf(level))));
            }
        } else {
            addPicture(picture, textures);
        }
    }
}

void PaintTextures::set(std::span<const SilhouetteModels::Object> objects) {
    setPictures(objects);
    levels_.clear();
    std::map<Textures, std::uint32_t> firstLevels;
    for (const auto& [textures, picture] : pictures_) {
        firstLevels[textures] = static_cast<std::uint32_t>(levels_.size());
        levels_.insert(levels_.end(), picture.levels.begin(), picture.levels.end());
    }
    constexpr Factor kPlain{1, 1, 1, 1};
    std::map<Factor, std::uint32_t> factors{{kPlain, 0}};
    factors_.assign(kPlain.begin(), kPlain.end());
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> paints;
    materials_.clear();
    for (const SilhouetteModels::Object& object : objects)
        for (const SilhouetteModels::Part& part : object.shape->parts) {
            const Textures textures = texturesOf(part);
            const std::vector<PaintLevel>& levels = pictures_.at(textures).levels;
            const Factor factor = factorOf(*part.material);
            const auto [at, isNew] =
                factors.try_emplace(factor, static_cast<std::uint32_t>(factors.size()));
            if (isNew) factors_.insert(factors_.end(), factor.begin(), factor.end());
            const std::uint32_t first = firstLevels.at(textures);
            const auto last = static_cast<std::uint32_t>(levels.size() - 1);
            const auto paint =
                paints.try_emplace({first, at->second}, static_cast<std::uint32_t>(paints.size()));
            materials_[&part] = {levels.front().size, first | last << 24, at->second,
                                 paint.first->second};
        }
}

}  // namespace mfar::simd
