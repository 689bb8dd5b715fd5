#pragma once

#include "base/workers.h"
#include "pipeline/plan/rgb_planes.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Measurements that decide whether a tile differs from the video with which it was last drawn.
struct TileMeasure {
    /// True if the tile certainly changed: the mean difference or the mean absolute difference of a
    /// cell exceeds the noise, or mean and slopes of the difference over the whole tile exceed the
    /// noise. The colour channel with the largest difference counts. markDrifted() can set
    /// `changed` later.
    bool changed = false;
    /// One bit for each cell, row-major: 1 if the cell's own differences exceed the thresholds of
    /// ChangeBounds.
    std::uint16_t changedCells = 0;
    float noise = 0;  ///< standard deviation of the video's noise [grey levels]
    /// Structure of the luma that can be matched. The luma is averaged over 2x2 pixels, and a plane
    /// fitted to 8x8 pixels is subtracted, because a plane cannot be matched. The result is the sum
    /// of squares, averaged over 9 positions in the tile.
    float structure = 0;
    /// Three mean squares of the difference between both lumas, scaled so that white noise makes
    /// them equal. Four values a b above c d have the twist (a - b - c + d) / 2; slopes do not
    /// change it (after Immerkaer, Fast noise variance estimation, 1996). `pixels`: mean square of
    /// the twists of 2x2 pixels. `means`: mean square of the means of 2x2 pixels. `bends`: mean
    /// square of the twists of 2x2 such means.
    float pixels = 0, means = 0, bends = 0;
};

struct ChangeBounds {
    /// Largest mean difference and largest mean absolute difference of an unchanged cell [grey
    /// levels].
    float mean, absolute;
    /// Noise variance of 2x2 means, divided by a quarter of a pixel's noise variance.
    float grain;
};

/// Measures every tile. `out` is row-major; its values are in [0, 1.1e6]. Both pictures must have
/// the same size. If `workers` is null, the caller's thread does all work. The result does not
/// depend on the number of threads.
void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out);

}  // namespace mfar
