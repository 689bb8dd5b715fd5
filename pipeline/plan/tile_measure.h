#pragma once

#include "base/workers.h"
#include "pipeline/plan/rgb_planes.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// What tells whether a tile of the video differs from the picture it was last drawn from.
struct TileMeasure {
    /// A cell's mean difference is beyond its noise, or its mean absolute difference, which shows
    /// fine structure that moved, or the tile's mean and slopes are. Colour counts by its largest
    /// channel. What is too weak for one tile shows in many: that is for markDrifted().
    bool changed = false;
    /// The cells of 4x4 pixels that surely did by themselves, a bit each, row-major.
    std::uint16_t changedCells = 0;
    float noise = 0;  ///< standard deviation of the video's noise [grey levels]
    /// What of the luma's 2x2 means the plane through 8x8 pixels leaves: the sum of squares, mean
    /// of the tile's 9 places. A slope alone tells no match from another.
    float structure = 0;
    /// Mean squares of the luma's difference, scaled so that all of white noise are its variance:
    /// of its pixels (their twist), of 2x2 means, of their twist. A twist is (a - b - c + d) / 2 of
    /// 2x2 values, which is blind to slopes (after Immerkaer, Fast noise variance estimation,
    /// 1996).
    float pixels = 0, means = 0, bends = 0;
};

/// From where on a tile surely changed.
struct ChangeBounds {
    float mean, absolute;  ///< of a cell's differences [grey levels]
    float grain;           ///< noise variance of 2x2 means in quarters of a pixel's
};

/// Measures every tile, row-major, 0..1.1e6. Both pictures of one size. Without `workers` in this
/// thread; the same whatever their number.
void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out);

}  // namespace mfar
