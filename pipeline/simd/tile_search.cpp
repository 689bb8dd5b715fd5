#include "pipeline/simd/tile_search.h"

#include "pipeline/engine/params/flow.h"
#include "pipeline/flow/least_texture.h"

#include <algorithm>

namespace mfar::simd {
namespace {

int divideUp(int a, int b) {
    return (a + b - 1) / b;
}

Size tilesOfCells(Size cells) {
    return {divideUp(cells.width, kCellsPerTile), divideUp(cells.height, kCellsPerTile)};
}

bool anyWithin(const TileMask& mask, TileSearch::Group first, TileSearch::Group end) {
    for (int y = std::max(first.y, 0); y < std::min(end.y, mask.size.height); ++y)
        for (int x = std::max(first.x, 0); x < std::min(end.x, mask.size.width); ++x)
            if (mask.at(x, y) != 0) return true;
    return false;
}

}  // namespace

void widen(const TileMask& in, int margin, TileMask& between, TileMask& out) {
    const auto spread = [margin](int size, auto from, auto to) {
        for (int i = 0; i < size; ++i) {
            std::uint8_t any = 0;
            for (int k = std::max(i - margin, 0); k <= std::min(i + margin, size - 1); ++k)
                any |= from(k);
            to(i) = any;
        }
    };
    for (int y = 0; y < in.size.height; ++y)
        spread(
            in.size.width, [&](int x) { return in.at(x, y); },
            [&](int x) -> std::uint8_t& { return between.at(x, y); });
    for (int x = 0; x < in.size.width; ++x)
        spread(
            in.size.height, [&](int y) { return between.at(x, y); },
            [&](int y) -> std::uint8_t& { return out.at(x, y); });
}

TileSearch::TileSearch(Size cells, int levels)
    : unexplained_(tilesOfCells(cells)), flagged_(unexplained_.size),
      groups_(static_cast<std::size_t>(levels)), listed_(unexplained_.flags.size()) {
    for (int level = 0; level < levels; ++level)
        groups_[static_cast<std::size_t>(level)].reserve(
            static_cast<std::size_t>(divideUp(flagged_.size.width, 1 << level)) *
            divideUp(flagged_.size.height, 1 << level));
}

void TileSearch::clear() {
    for (auto& level : groups_)
        level.clear();
    std::fill(listed_.begin(), listed_.end(), false);
}

void TileSearch::flag(const FlowPlanes& field, std::span<const ErrorCell> errors, double noise) {
    const float least = leastTexture(noise);
    std::ranges::fill(unexplained_.flags, std::uint8_t{0});
    for (int y = 0; y < field.rows; ++y)
        for (int x = 0; x < field.columns; ++x) {
            const std::ptrdiff_t at = y * field.pitch + x;
            const bool shown =
                errors[static_cast<std::size_t>(y) * field.columns + x].error < params::kNotShown;
            if (shown && field.cost[at] > params::kUnexplainedCost && field.texture[at] > least)
                ++unexplained_.at(x / kCellsPerTile, y / kCellsPerTile);
        }
    for (std::uint8_t& tile : unexplained_.flags)
        tile = tile >= params::kLeastUnexplained ? 1 : 0;
}

void TileSearch::find(const FlowPlanes& field, std::span<const ErrorCell> errors, double noise) {
    clear();
    flag(field, errors, noise);
    if (std::ranges::find(unexplained_.flags, 1) == unexplained_.flags.end()) return;
    const Size size = flagged_.size;
    const auto flagAt = [&](int x, int y) {
        const bool within = x >= 0 && y >= 0 && x < size.width && y < size.height;
        return within ? int{unexplained_.at(x, y)} : 0;
    };
    // A tile with at least two flagged neighbours is flagged too. It may be a textureless part of a
    // moving object. Wrong matches in such a part have a low cost and are not noticed.
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int beside =
                flagAt(x - 1, y) + flagAt(x + 1, y) + flagAt(x, y - 1) + flagAt(x, y + 1);
            flagged_.at(x, y) = flagAt(x, y) != 0 || beside >= 2 ? 1 : 0;
        }
    for (std::size_t level = 0; level < groups_.size(); ++level) {
        const int side = 1 << level;
        // A group is listed if a flagged tile is within this margin around it [tiles]. The search
        // in a group reads the adjacent groups of the next coarser pyramid level, so the margin
        // grows from level to level.
        const int margin = 2 * side - 2;
        for (int y = 0; y < divideUp(size.height, side); ++y)
            for (int x = 0; x < divideUp(size.width, side); ++x)
                if (anyWithin(flagged_, {side * x - margin, side * y - margin},
                              {side * (x + 1) + margin, side * (y + 1) + margin}))
                    groups_[level].push_back({x, y});
    }
    for (const Group& tile : groups_[0])
        listed_[static_cast<std::size_t>(tile.y) * size.width + tile.x] = true;
}

}  // namespace mfar::simd
