#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/plan/tile_measure.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Sums over the tiles that are not certainly changed.
struct TileEnergy {
    int tiles = 0;
    double pixels = 0, means = 0, bends = 0;  ///< sums, see TileMeasure

    void add(const TileMeasure& tile);
    /// Whether the 2x2 means vary by more than noise explains (`grain` times the noise of the
    /// pixels). This finds changes that are too weak for a single tile, such as a smooth slope that
    /// moves.
    [[nodiscard]] bool drifted(double grain) const;
};

/// Marks all tiles of a block of 8x8 tiles as changed if the block has drifted. Marks all tiles if
/// the whole picture has drifted or `all` is true. `tiles` is row-major with `columns` tiles per
/// row. Returns the sums over all tiles before marking.
TileEnergy markDrifted(std::span<TileMeasure> tiles, int columns, double grain, bool all);

/// Marks tiles as changed if an adjacent tile certainly changed in a cell at the common border,
/// because enlarging reads two pixels beyond a tile.
void markBeside(std::span<TileMeasure> tiles, int columns);

/// Chooses tiles whose structure exceeds the noise, and their neighbours, because the weight of a
/// cell depends on pixels beyond its tile. If there are too many, those with the most structure are
/// chosen. Tiles of the last choice are preferred, so that noise does not make detail appear and
/// vanish.
class StructuredTiles {
public:
    /// Structure up to `none` is noise. If `none` is negative, every tile has structure. `most`
    /// limits the number of tiles.
    void choose(std::span<const TileMeasure> tiles, int columns, double none, int most);
    [[nodiscard]] bool operator[](std::size_t tile) const { return chosen_[tile]; }
    [[nodiscard]] int count() const;
    /// The smallest rectangle that contains all chosen tiles [tiles].
    [[nodiscard]] PixelRect bounds(int columns) const;

private:
    std::vector<bool> chosen_;
    std::vector<float> around_;
};

}  // namespace mfar
