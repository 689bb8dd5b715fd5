#pragma once

#include "base/geometry.h"
#include "base/image_view.h"
#include "pipeline/plan/tile_measure.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mfar {

/// Number of tiles that are not marked as changed, and sums of their TileMeasure values.
struct TileEnergy {
    int tiles = 0;
    double pixels = 0, means = 0, bends = 0;

    void add(const TileMeasure& tile);
    /// Returns true if the sum `means` is significantly larger than `grain` * `pixels`, its
    /// expected value with noise alone. This finds changes that are too weak to be found in one
    /// tile, such as a moving smooth slope of brightness.
    [[nodiscard]] bool drifted(double grain) const;
};

/// Marks all tiles of a block of 8x8 tiles as changed if TileEnergy::drifted() is true for the
/// block. Marks all tiles if it is true for the whole picture. `tiles` is row-major with `columns`
/// tiles per row. Returns the TileEnergy of the tiles that were not marked before the call.
TileEnergy markDrifted(std::span<TileMeasure> tiles, int columns, double grain);

/// Marks a tile as changed if, in an adjacent tile, a cell at the common border certainly changed.
/// The tile must be drawn again, because enlarging it reads two pixels of the adjacent tile.
void markBeside(std::span<TileMeasure> tiles, int columns);

/// Chooses the tiles that are matched with the still. These are the tiles whose structure exceeds
/// the noise, and the neighbours of such tiles. (The weight of a cell depends on pixels beyond its
/// tile.) If more than `most` tiles qualify, those with the most structure are chosen. Of tiles
/// with about the same structure, those nearest to the centre of the picture are chosen. Tiles of
/// the last choice are preferred, so that noise does not make detail appear and vanish.
class StructuredTiles {
public:
    /// A tile has structure if its TileMeasure::structure exceeds `none`, or if `none` is negative.
    /// `most` is the upper limit of the number of chosen tiles.
    void choose(std::span<const TileMeasure> tiles, int columns, double none, int most);
    [[nodiscard]] bool operator[](std::size_t tile) const { return chosen_[tile]; }
    [[nodiscard]] int count() const;
    /// Returns the number of tiles that could have been chosen, [count(), number of tiles].
    [[nodiscard]] int candidates() const { return candidates_; }
    /// The smallest rectangle around all chosen tiles [tiles].
    [[nodiscard]] PixelRect bounds(int columns) const;

private:
    void chooseCentral(int columns, int most);

    std::vector<bool> chosen_;
    std::vector<float> around_;
    std::vector<int> alike_;  // tiles of the structure bin from which only some are chosen
    int candidates_ = 0;
};

}  // namespace mfar
