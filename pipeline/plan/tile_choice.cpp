#include "pipeline/plan/tile_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace mfar {
namespace {

constexpr int kTileBlock = 8;
// kSpread: standard deviation of the mean square of noise in one tile, as a fraction of the
// expected mean square. TileEnergy::means is significantly too large if it exceeds its expected
// value by more than kSignificant standard deviations.
constexpr double kSpread = 0.27;
constexpr double kSignificant = 5;
// An excess of TileEnergy::means over its expected value never counts as a change if it is below
// this fraction of the expected value. Rounding to 8 bits is not white noise and can cause such
// excesses.
constexpr double kLeast = 0.03;

constexpr int kStructureBins = 84;  // a bin is a quarter of an octave
constexpr float kKept = 1.19F;      // factor for the structure of tiles of the last choice

int structureBin(float structure) {
    return std::clamp(static_cast<int>(4 * std::log2(structure + 1)), 0, kStructureBins - 1);
}

float structureAround(std::span<const TileMeasure> tiles, int columns, int at) {
    const int x = at % columns, y = at / columns;
    const int lastRow = static_cast<int>(tiles.size()) / columns - 1;
    float most = 0;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, lastRow); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
            most = std::max(most, tiles[static_cast<std::size_t>(j) * columns + i].structure);
    return most;
}

}  // namespace

void TileEnergy::add(const TileMeasure& tile) {
    if (tile.changed) return;
    ++tiles;
    pixels += tile.pixels;
    means += tile.means;
    bends += tile.bends;
}

bool TileEnergy::drifted(double grain) const {
    const double room = std::max(kSignificant * kSpread / std::sqrt(std::max(tiles, 1)), kLeast);
    return means > (1 + room) * grain * pixels + 0.01 * tiles;
}

TileEnergy markDrifted(std::span<TileMeasure> tiles, int columns, double grain) {
    TileEnergy total;
    for (const TileMeasure& tile : tiles)
        total.add(tile);
    const bool all = total.drifted(grain);
    const int rows = static_cast<int>(tiles.size()) / columns;
    const auto forBlock = [&](int left, int top, const auto& body) {
        for (int y = top; y < std::min(top + kTileBlock, rows); ++y)
            for (int x = left; x < std::min(left + kTileBlock, columns); ++x)
                body(tiles[static_cast<std::size_t>(y) * columns + x]);
    };
    for (int top = 0; top < rows; top += kTileBlock)
        for (int left = 0; left < columns; left += kTileBlock) {
            TileEnergy block;
            forBlock(left, top, [&](const TileMeasure& tile) { block.add(tile); });
            if (all || block.drifted(grain))
                forBlock(left, top, [](TileMeasure& tile) { tile.changed = true; });
        }
    return total;
}

void markBeside(std::span<TileMeasure> tiles, int columns) {
    struct Side {
        unsigned cells;
        int x, y;
    };
    constexpr std::array<Side, 8> kSides{{{0x1111, -1, 0},
                                          {0x8888, 1, 0},
                                          {0x000F, 0, -1},
                                          {0xF000, 0, 1},
                                          {0x0001, -1, -1},
                                          {0x0008, 1, -1},
                                          {0x1000, -1, 1},
                                          {0x8000, 1, 1}}};
    const int rows = static_cast<int>(tiles.size()) / columns;
    for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
        const unsigned cells = tiles[static_cast<std::size_t>(i)].changedCells;
        if (cells == 0) continue;
        for (const Side& side : kSides) {
            const int x = i % columns + side.x, y = i / columns + side.y;
            if ((cells & side.cells) != 0 && x >= 0 && y >= 0 && x < columns && y < rows)
                tiles[static_cast<std::size_t>(y) * columns + x].changed = true;
        }
    }
}

void StructuredTiles::choose(std::span<const TileMeasure> tiles, int columns, double none,
                             int most) {
    chosen_.resize(tiles.size());
    around_.resize(tiles.size());
    std::array<int, kStructureBins> bins{};
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const float kept = chosen_[i] ? kKept : 1;
        around_[i] = kept * structureAround(tiles, columns, static_cast<int>(i));
        if (around_[i] > none) ++bins[structureBin(around_[i])];
    }
    candidates_ = std::accumulate(bins.begin(), bins.end(), 0);
    int above = 0, least = kStructureBins;
    while (least > 0 && above + bins[least - 1] <= most)
        above += bins[--least];
    alike_.clear();
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const int bin = around_[i] > none ? structureBin(around_[i]) : -1;
        chosen_[i] = bin >= least;
        if (bin >= 0 && bin == least - 1) alike_.push_back(static_cast<int>(i));
    }
    chooseCentral(columns, most - above);
}

void StructuredTiles::chooseCentral(int columns, int most) {
    const auto rows = static_cast<int>(chosen_.size()) / columns;
    const auto distance = [&](int tile) {
        const int x = 2 * (tile % columns) - columns + 1, y = 2 * (tile / columns) - rows + 1;
        return std::pair(x * x + y * y, tile);
    };
    const auto end = alike_.begin() + std::clamp(most, 0, static_cast<int>(alike_.size()));
    std::ranges::nth_element(alike_, end, {}, distance);
    std::for_each(alike_.begin(), end, [&](int tile) { chosen_[tile] = true; });
}

int StructuredTiles::count() const {
    return static_cast<int>(std::ranges::count(chosen_, true));
}

PixelRect StructuredTiles::bounds(int columns) const {
    PixelRect out;
    for (int i = 0; i < static_cast<int>(chosen_.size()); ++i) {
        const int x = i % columns, y = i / columns;
        if (chosen_[static_cast<std::size_t>(i)]) out = around(out, {x, y, x + 1, y + 1});
    }
    return out;
}

}  // namespace mfar
