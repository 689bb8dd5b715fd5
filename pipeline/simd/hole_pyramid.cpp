#include "pipeline/simd/hole_pyramid.h"

#include "pipeline/warp/pass_params.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar::simd {
namespace {

std::uint32_t rounded(float value) {
    const float above = value + 0.5F;
    return static_cast<std::uint32_t>(above);
}

constexpr std::uint32_t kAnyObject = 254;
constexpr int kBlockShift = HolePyramid::kLevels;
constexpr std::size_t kHolesAtATime = 32;

int halved(int pixels) {
    return (pixels + 1) / 2;
}

std::uint32_t mean(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    constexpr std::uint32_t kEven = 0x00FF00FF, kHalf = 0x00020002;
    const auto sum = [&](unsigned shift) {
        return ((a >> shift & kEven) + (b >> shift & kEven) + (c >> shift & kEven) +
                (d >> shift & kEven) + kHalf) >>
                   2 &
               kEven;
    };
    return sum(0) | sum(8) << 8;
}

struct Mixture {
    std::array<float, 4> rgba{};
    float weight = 0;

    void add(std::uint32_t colour, float w) {
        weight += w;
        for (unsigned c = 0; c < 4; ++c)
            rgba[c] += w * static_cast<float>(colour >> 8 * c & 255U);
    }
    [[nodiscard]] std::uint32_t colour() const {
        if (!(weight > 0)) return 0;
        std::uint32_t out = 0;
        for (unsigned c = 0; c < 4; ++c)
            out |= rounded(std::min(rgba[c] / weight, 255.0F)) << 8 * c;
        return out;
    }
};

std::uint8_t halfWeight(float sum) {
    return static_cast<std::uint8_t>(rounded(std::min(0.5F * sum, 255.0F)));
}

}  // namespace

HolePyramid::HolePyramid(Size layer, std::shared_ptr<Workers> workers)
    : width_(layer.width), workers_(std::move(workers)) {}

void HolePyramid::fill(const Layer& layer, std::span<Hole> holes, HoleFilling filling) {
    if (holes.empty()) return;
    levelCount_ = fillsShadows(filling) ? kLevels : params::kCrackLevels;
    markBlocks(layer.where, holes);
    PixelRect r = layer.where;
    for (int l = 0; l < levelCount_; ++l) {
        r = {r.x0 / 2, r.y0 / 2, halved(r.x1), halved(r.y1)};
        levels_[l].texels = r;
        const std::size_t texels = static_cast<std::size_t>(r.area());
        if (levels_[l].areas.size() < texels) levels_[l].areas.resize(texels);
        pull(layer, l);
    }
    const int count = static_cast<int>(holes.size());
    forRows(workers_.get(), 0, count, kHolesAtATime,
            [&](int i) { fillHole(layer, holes[static_cast<std::size_t>(i)], filling); });
}

/// Marks the blocks in which fillHole() reads texels: at each pyramid level, the block that
/// contains the hole, and the neighbouring blocks.
void HolePyramid::markBlocks(const PixelRect& where, std::span<const Hole> holes) {
    blocks_ = {where.x0 >> kBlockShift, where.y0 >> kBlockShift,
               ((where.x1 - 1) >> kBlockShift) + 1, ((where.y1 - 1) >> kBlockShift) + 1};
    const int columns = blocks_.x1 - blocks_.x0;
    blockWanted_.assign(static_cast<std::size_t>(columns) * (blocks_.y1 - blocks_.y0), 0);
    for (const Hole& hole : holes) {
        const int x = (static_cast<int>(hole.pixel) % width_) >> kBlockShift;
        const int y = (static_cast<int>(hole.pixel) / width_) >> kBlockShift;
        for (int v = std::max(y - 1, blocks_.y0); v <= std::min(y + 1, blocks_.y1 - 1); ++v)
            for (int u = std::max(x - 1, blocks_.x0); u <= std::min(x + 1, blocks_.x1 - 1); ++u)
                blockWanted_[static_cast<std::size_t>(v - blocks_.y0) * columns + u - blocks_.x0] =
                    1;
    }
}

/// Merges four texels into one texel of the next coarser pyramid level. The new texel stores two
/// surfaces: the object that covers most of it, and the shadow catcher. A surface that covers at
/// least half of the texel gets full weight (255).
HolePyramid::Area HolePyramid::merged(const std::array<Area, 4>& parts) {
    Area out;
    Mixture best, catcher;
    for (std::size_t i = 0; i < 4; ++i) {
        if (parts[i].catcherWeight > 0) catcher.add(parts[i].catcher, parts[i].catcherWeight);
        if (parts[i].objectWeight == 0) continue;
        Mixture own;
        for (const Area& part : parts)
            if (part.id == parts[i].id) own.add(part.object, part.objectWeight);
        if (!(own.weight > best.weight)) continue;
        best = own;
        out.id = parts[i].id;
    }
    out.object = best.colour();
    out.catcher = catcher.colour();
    out.objectWeight = halfWeight(best.weight);
    out.catcherWeight = halfWeight(catcher.weight);
    return out;
}

HolePyramid::Area HolePyramid::firstLevelArea(const Layer& layer, int x, int y) const {
    const PixelRect& where = layer.where;
    std::array<Area, 4> parts;
    std::array<std::uint32_t, 4> ids{}, colours{};
    for (int i = 0; i < 4; ++i) {
        const int u = 2 * x + (i & 1), v = 2 * y + (i >> 1);
        if (u < where.x0 || v < where.y0 || u >= where.x1 || v >= where.y1) continue;
        ids[i] = layer.state[v][u] >> 24;
        colours[i] = layer.colour[v][u];
    }
    if ((ids[0] | ids[1] | ids[2] | ids[3]) == 0) return {};
    if (ids[0] == ids[1] && ids[0] == ids[2] && ids[0] == ids[3]) {
        const std::uint32_t colour = mean(colours[0], colours[1], colours[2], colours[3]);
        if (ids[0] == kCatcherNumber) return {0, colour, 0, 0, 255};
        return {colour, 0, static_cast<std::uint8_t>(ids[0]), 255, 0};
    }
    for (std::size_t i = 0; i < 4; ++i) {
        if (ids[i] == kCatcherNumber)
            parts[i] = {0, colours[i], 0, 0, 255};
        else if (ids[i] != 0)
            parts[i] = {colours[i], 0, static_cast<std::uint8_t>(ids[i]), 255, 0};
    }
    return merged(parts);
}

HolePyramid::Area HolePyramid::areaAt(int level, int x, int y) const {
    const Level& l = levels_[level];
    const PixelRect& r = l.texels;
    if (x < r.x0 || y < r.y0 || x >= r.x1 || y >= r.y1) return {};
    return l.areas[static_cast<std::size_t>(y - r.y0) * (r.x1 - r.x0) + x - r.x0];
}

void HolePyramid::pull(const Layer& layer, int level) {
    const PixelRect& r = levels_[level].texels;
    const int shift = kBlockShift - 1 - level, columns = blocks_.x1 - blocks_.x0;
    const auto rows = [&](int row, int end) {
        for (; row < end; ++row) {
            const int y = r.y0 + row;
            const int v = std::min(y >> shift, blocks_.y1 - 1) - blocks_.y0;
            const std::uint8_t* wanted = &blockWanted_[static_cast<std::size_t>(v) * columns];
            Area* out = &levels_[level].areas[static_cast<std::size_t>(row) * (r.x1 - r.x0)];
            for (int x = r.x0; x < r.x1; ++x, ++out) {
                const int u = std::min(x >> shift, blocks_.x1 - 1) - blocks_.x0;
                if (wanted[u] == 0) {
                    *out = {};
                    continue;
                }
                if (level == 0) {
                    *out = firstLevelArea(layer, x, y);
                    continue;
                }
                const int a = 2 * x, b = 2 * y, below = level - 1;
                const std::array parts{areaAt(below, a, b), areaAt(below, a + 1, b),
                                       areaAt(below, a, b + 1), areaAt(below, a + 1, b + 1)};
                *out = merged(parts);
            }
        }
    };
    forRange(workers_.get(), r.y1 - r.y0, 8, rows);
}

/// Adds the colour of one pyramid level at a pixel, interpolated bilinearly. The colour's weight is
/// the part of the pixel that finer levels left uncovered.
void HolePyramid::addLevel(int level, int x, int y, std::uint32_t id, Sum& sum) const {
    const float scale = 1.0F / static_cast<float>(2 << level);
    const float u = (static_cast<float>(x) + 0.5F) * scale - 0.5F;
    const float v = (static_cast<float>(y) + 0.5F) * scale - 0.5F;
    const float lowX = std::floor(u), lowY = std::floor(v), fx = u - lowX, fy = v - lowY;
    Mixture own;
    for (int i = 0; i < 4; ++i) {
        const int right = i & 1, down = i >> 1;
        const Area area =
            areaAt(level, static_cast<int>(lowX) + right, static_cast<int>(lowY) + down);
        const bool ofCatcher = id == kCatcherNumber;
        const bool shown = area.id == id || id == kAnyObject;
        const int weight = ofCatcher ? area.catcherWeight : shown ? area.objectWeight : 0;
        if (weight == 0) continue;
        const float near = (right != 0 ? fx : 1 - fx) * (down != 0 ? fy : 1 - fy);
        own.add(ofCatcher ? area.catcher : area.object, near * static_cast<float>(weight) / 255);
    }
    const float rest = 1 - sum.weight;
    for (std::size_t c = 0; c < 4; ++c)
        sum.rgba[c] += rest * own.rgba[c];
    sum.weight += rest * own.weight;
}

HolePyramid::Sum HolePyramid::gathered(int x, int y, std::uint32_t id, int last) const {
    Sum sum;
    for (int l = 0; l < last && sum.weight < 0.99F; ++l)
        addLevel(l, x, y, id, sum);
    return sum;
}

namespace {

bool isCrack(const HolePyramid::Layer& layer, int x, int y, std::uint32_t id) {
    const PixelRect& where = layer.where;
    int same = 0;
    for (int v = std::max(y - 1, where.y0); v <= std::min(y + 1, where.y1 - 1); ++v)
        for (int u = std::max(x - 1, where.x0); u <= std::min(x + 1, where.x1 - 1); ++u)
            same += (u != x || v != y) && layer.state[v][u] >> 24 == id ? 1 : 0;
    return same >= 5;
}

}  // namespace

/// Fills a hole with colours of its own object. An object that has just appeared from behind others
/// has no known colour. Then the colours of all surrounding objects are used, because the object
/// would look transparent without a colour.
void HolePyramid::fillHole(const Layer& layer, Hole& hole, HoleFilling filling) const {
    const int x = static_cast<int>(hole.pixel) % width_, y = static_cast<int>(hole.pixel) / width_;
    const std::uint32_t state = layer.state[y][x], id = state & 255U;
    hole.isEdge = hole.isEdge || isCrack(layer, x, y, id);
    const bool fills = id == kCatcherNumber ? fillsShadows(filling) : pushPulls(filling);
    if (!hole.isEdge && !fills) return;
    const int last = fills ? levelCount_ : params::kCrackLevels;
    Sum sum = gathered(x, y, id, last);
    if (sum.weight == 0 && id != kCatcherNumber) sum = gathered(x, y, kAnyObject, last);
    if (!(sum.weight > 0)) return;
    const float part = static_cast<float>(state >> 8 & 255U) / 255;
    std::uint32_t out = 0;
    for (unsigned c = 0; c < 4; ++c) {
        const float own = static_cast<float>(hole.colour >> 8 * c & 255U);
        const float value = std::min(own + part * sum.rgba[c] / sum.weight, 255.0F);
        out |= rounded(value) << 8 * c;
    }
    layer.colour[y][x] = out;
}

}  // namespace mfar::simd
