#pragma once

#include "base/workers.h"
#include "pipeline/plan/rgb_planes.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Measurements of a tile. They decide whether the video differs from the video from which the tile
/// was last drawn.
struct TileMeasure {
    /// Whether the tile certainly changed. True in three cases: the mean difference of a cell
    /// exceeds the noise, the mean absolute difference of a cell exceeds the noise (fine structure
    /// moved), or the mean and the slopes of the tile's difference exceed the noise. The colour
    /// channel with the largest difference counts. markDrifted() also sets `changed`, for changes
    /// that are too weak to be found in one tile.
    bool changed = false;
    /// A bit for each cell of 4x4 pixels, row-major: 1 if the cell's own differences exceed the
    /// thresholds of ChangeBounds.
    std::uint16_t changedCells = 0;
    float noise = 0;  ///< standard deviation of the video's noise [grey levels]
    /// Structure of the luma: a plane is fitted to 8x8 pixels and subtracted from the means of
    /// their 2x2 blocks, and the squares of the remainders are summed. The result is the mean over
    /// 9 positions in the tile. The plane is subtracted because a brightness that is a plane cannot
    /// be matched.
    float structure = 0;
    /// The mean squares of three measures of the difference between both lumas. `pixels`: twist of
    /// pixels; `means`: means over 2x2 pixels; `bends`: twist of these means. They are scaled so
    /// that white noise gives the same value in each. The twist of 2x2 values is (a - b - c + d) /
    /// 2; slopes do not affect it (after Immerkaer, Fast noise variance estimation, 1996).
    float pixels = 0, means = 0, bends = 0;
};

/// Limits of differences above which a tile has certainly changed.
struct ChangeBounds {
    float mean, absolute;  ///< largest mean difference and largest mean absolute difference of an
                           ///< unchanged cell [grey levels]
    float grain;           ///< noise variance of means over 2x2 pixels, divided by a quarter of a
                           ///< pixel's noise variance
};

/// Measures every tile, row-major. Values are in 0..1.1e6. Both pictures must have the same size.
/// If `workers` is null, everything runs in the caller's thread. The result does not depend on the
/// number of threads.
void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out);

}  // namespace mfar
