#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/plan/tile_measure.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// What tiles that did not surely change show together.
struct TileEnergy {
    int tiles = 0;
    double pixels = 0, means = 0, bends = 0;  ///< sums, see TileMeasure

    void add(const TileMeasure& tile);
    /// 2x2 means vary by more than `grain` times the noise of the pixels explains: something
    /// changed that is too weak for one tile, as a smooth slope that moves.
    [[nodiscard]] bool drifted(double grain) const;
};

/// Marks tiles as changed where they drifted, over each block of 8x8 or over all, or where all are
/// to be. Row-major, `columns` a row. The energy of all before that.
TileEnergy markDrifted(std::span<TileMeasure> tiles, int columns, double grain, bool all);

/// Marks tiles as changed beside whose border cells surely changed: enlarging looks two pixels
/// beyond a tile.
void markBeside(std::span<TileMeasure> tiles, int columns);

/// Chooses tiles with structure beyond noise, and those beside them, as the weight of a cell looks
/// beyond its tile; where there are too many, those with the most, and rather those that were
/// chosen before: noise must not make detail come and go.
class StructuredTiles {
public:
    /// Structure up to `none` is noise; below 0 nothing is. `most`: at most so many tiles.
    void choose(std::span<const TileMeasure> tiles, int columns, double none, int most);
    [[nodiscard]] bool operator[](std::size_t tile) const { return chosen_[tile]; }
    [[nodiscard]] int count() const;
    /// The least rectangle with all in it.
    [[nodiscard]] PixelRect bounds(int columns) const;

private:
    std::vector<bool> chosen_;
    std::vector<float> around_;
};

}  // namespace mfar
