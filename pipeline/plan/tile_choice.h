#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/plan/tile_measure.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Sums over the tiles that did not certainly change.
struct TileEnergy {
    int tiles = 0;
    double pixels = 0, means = 0, bends = 0;  ///< sums, see TileMeasure

    void add(const TileMeasure& tile);
    /// 2x2 means vary by more than `grain` times the pixels' noise explains: a change that is too
    /// weak to show in one tile, such as a smooth slope that moves.
    [[nodiscard]] bool drifted(double grain) const;
};

/// Marks tiles as changed where a block of 8x8 tiles or the whole picture drifted; with `all`,
/// everywhere. Row-major, `columns` a row. Returns the sums over all tiles before that.
TileEnergy markDrifted(std::span<TileMeasure> tiles, int columns, double grain, bool all);

/// Marks tiles next to border cells that certainly changed: enlarging reads two pixels beyond a
/// tile.
void markBeside(std::span<TileMeasure> tiles, int columns);

/// Chooses tiles with structure above the noise and their neighbours (a cell's weight reads beyond
/// its tile). If there are too many, those with the most structure, with tiles of the last choice
/// preferred, so that noise does not make detail come and go.
class StructuredTiles {
public:
    /// Structure up to `none` is noise; a negative `none` takes every tile. `most`: limit on the
    /// number of tiles.
    void choose(std::span<const TileMeasure> tiles, int columns, double none, int most);
    [[nodiscard]] bool operator[](std::size_t tile) const { return chosen_[tile]; }
    [[nodiscard]] int count() const;
    /// The smallest rectangle that holds all chosen tiles.
    [[nodiscard]] PixelRect bounds(int columns) const;

private:
    std::vector<bool> chosen_;
    std::vector<float> around_;
};

}  // namespace mfar
