#include "pipeline/simd/tile_classes.h"

#include "pipeline/engine/params/detail.h"
#include "pipeline/simd/detail_kernels.h"

#include <algorithm>
#include <cmath>

namespace mfar::simd {
namespace {

constexpr int kCells = 4;
constexpr int kWithBorder = 6;  // kCells and a border of one cell on each side
constexpr int kTileRowGrain = 4;

}  // namespace

struct TileClasses::Fields {
    Rows<const WeighedCell> weighed;
    Rows<const TrustCell> trust;
    Match second;
    float leastWeight, plainFlow;

    [[nodiscard]] bool known() const { return weighed.data != nullptr; }
    template <class Cell>
    [[nodiscard]] static const Cell& at(const Rows<const Cell>& field, int x, int y) {
        return field[std::clamp(y, 0, field.size.height - 1)]
                    [std::clamp(x, 0, field.size.width - 1)];
    }
    [[nodiscard]] TileClass classOf(int column, int row) const;
    [[nodiscard]] int unexplainedCells(int column, int row) const;
    /// These two functions also read the cells next to the tile, because the weights of the tile's
    /// outer pixels are interpolated with them.
    [[nodiscard]] bool showsSecond(int column, int row) const;
    [[nodiscard]] bool showsStillAlone(int column, int row) const;
    [[nodiscard]] bool secondExplains(int x, int y) const {
        return second.weighed.data != nullptr && at(second.trust, x, y).unexplained < 0.5F &&
               at(second.weighed, x, y).weight > at(weighed, x, y).weight + params::kSecondFrom;
    }
    [[nodiscard]] float confidence(int column, int row) const;
};

// A tile gets the class Trusted if its flow is an affine function of the position (within
// kPlainFlow) and its weight is constant (within kPlainWeight). A flow with NaN is not affine.
TileClass TileClasses::Fields::classOf(int column, int row) const {
    const int x0 = kCells * column, y0 = kCells * row;
    std::array<WeighedCell, kWithBorder * kWithBorder> cells;
    float low = 1e9F, high = -1e9F;
    for (int i = 0; i < kWithBorder * kWithBorder; ++i) {
        cells[i] = at(weighed, x0 + i % kWithBorder - 1, y0 + i / kWithBorder - 1);
        low = std::min(low, cells[i].weight);
        high = std::max(high, cells[i].weight);
    }
    if (!(high > leastWeight)) return TileClass::Enlarged;
    if (!(high - low < params::kPlainWeight)) return TileClass::Blended;
    const WeighedCell &origin = cells[kWithBorder + 1], &right = cells[kWithBorder + 4],
                      &below = cells[4 * kWithBorder + 1];
    const auto affine = [&](float WeighedCell::* axis) {
        const float dx = (right.*axis - origin.*axis) / 3, dy = (below.*axis - origin.*axis) / 3;
        bool all = true;
        for (int i = 0; i < kWithBorder * kWithBorder; ++i) {
            const int across = i % kWithBorder, down = i / kWithBorder;
            const auto kx = static_cast<float>(across - 1), ky = static_cast<float>(down - 1);
            const float apart = cells[i].*axis - origin.*axis - kx * dx - ky * dy;
            all = all && std::abs(apart) < plainFlow;
        }
        return all;
    };
    return affine(&WeighedCell::x) && affine(&WeighedCell::y) ? TileClass::Trusted
                                                              : TileClass::Blended;
}

int TileClasses::Fields::unexplainedCells(int column, int row) const {
    int out = 0;
    for (int i = 0; i < kCells * kCells; ++i) {
        const int x = kCells * column + i % kCells, y = kCells * row + i / kCells;
        out += at(trust, x, y).unexplained >= 0.5F && !secondExplains(x, y) ? 1 : 0;
    }
    return out;
}

bool TileClasses::Fields::showsSecond(int column, int row) const {
    if (second.weighed.data == nullptr) return false;
    const int x0 = kCells * column - 1, y0 = kCells * row - 1;
    for (int i = 0; i < kWithBorder * kWithBorder; ++i) {
        const int x = x0 + i % kWithBorder, y = y0 + i / kWithBorder;
        if (at(second.weighed, x, y).weight > at(weighed, x, y).weight + params::kSecondFrom)
            return true;
    }
    return false;
}

// A weight that is NaN counts as zero.
bool TileClasses::Fields::showsStillAlone(int column, int row) const {
    const int x0 = kCells * column - 1, y0 = kCells * row - 1;
    for (int i = 0; i < kWithBorder * kWithBorder; ++i)
        if (!(at(weighed, x0 + i % kWithBorder, y0 + i / kWithBorder).weight >= 1)) return false;
    return true;
}

float TileClasses::Fields::confidence(int column, int row) const {
    float sum = 0;
    for (int i = 0; i < kCells * kCells; ++i)
        sum += at(weighed, kCells * column + i % kCells, kCells * row + i / kCells).confidence;
    return sum > 0 ? std::min(sum, 16.0F) : 0;
}

TileClasses::TileClasses(Size video)
    : tiles_(tilesOf(video)), classes_(static_cast<std::size_t>(tiles_.width) * tiles_.height),
      unexplained_(classes_.size()), second_(classes_.size()), alone_(classes_.size()),
      rowSums_(tiles_.height) {}

void TileClasses::classifyRow(const TileWork& work, const Fields& fields, int row) {
    TileSummary sum;
    for (int column = 0; column < tiles_.width; ++column) {
        const std::size_t index = static_cast<std::size_t>(row) * tiles_.width + column;
        const TileWork::Tile& tile = work.at(column, row);
        TileClass kind = TileClass::Unchanged;
        if (work.drawsWhole() || tile.changed != 0) {
            kind = fields.known() && tile.matched != 0 ? fields.classOf(column, row)
                                                       : TileClass::Enlarged;
            unexplained_[index] =
                fields.known() ? fields.unexplainedCells(column, row) : kCells * kCells;
            second_[index] = fields.known() && fields.showsSecond(column, row) ? 1 : 0;
            alone_[index] =
                fields.known() && tile.matched != 0 && fields.showsStillAlone(column, row);
            if (second_[index] != 0) kind = TileClass::Blended;
            sum.second += second_[index];
        }
        classes_[index] = kind;
        ++sum.tiles[static_cast<std::size_t>(kind)];
        if (unexplained_[index] >= static_cast<int>(params::kUnexplainedCells)) ++sum.unexplained;
        if (fields.known()) sum.confidence += std::floor(fields.confidence(column, row) * 16);
    }
    rowSums_[row] = sum;
}

TileSummary TileClasses::classify(const TileWork& work, const Match& match, const Match& second,
                                  Skips skips, Workers& workers) {
    const Fields fields{match.weighed, match.trust, second,
                        skips.enlargedTiles ? params::kLeastDetailWeight : -1.0F,
                        skips.plainTiles ? params::kPlainFlow : 0.0F};
    struct Loop {
        TileClasses& self;
        const TileWork& work;
        const Fields& fields;
    } loop{*this, work, fields};
    // The lambda captures only a reference, so that std::function stores it without allocating
    // memory.
    workers.forRange(tiles_.height, kTileRowGrain, [&loop](int first, int last) {
        for (int row = first; row < last; ++row)
            loop.self.classifyRow(loop.work, loop.fields, row);
    });
    TileSummary out;
    for (const TileSummary& row : rowSums_) {
        for (std::size_t i = 0; i < kTileClasses; ++i)
            out.tiles[i] += row.tiles[i];
        out.unexplained += row.unexplained;
        out.second += row.second;
        out.confidence += row.confidence;
    }
    return out;
}

}  // namespace mfar::simd
