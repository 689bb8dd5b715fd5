#pragma once

#include "base/workers.h"
#include "pipeline/plan/rgb_planes.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Measurements that decide whether a tile differs from the video with which it was last drawn.
struct TileMeasure {
    /// True if the tile's video certainly changed since the tile was last drawn. It changed if the
    /// mean difference or the mean absolute difference of one of its cells exceeds the noise, or if
    /// the mean and the slopes of the whole tile's difference together exceed the noise. The colour
    /// channel with the largest difference counts. markDrifted() and markBeside() can set `changed`
    /// later.
    bool changed = false;
    /// One bit for each cell, row-major: 1 if the cell certainly changed. Its mean absolute
    /// difference then exceeds ChangeBounds::absolute, or its mean difference exceeds
    /// ChangeBounds::mean and the noise in the tile.
    std::uint16_t changedCells = 0;
    float noise = 0;  ///< standard deviation of the video's noise [grey levels]
    /// Structure of the luma that a match can use. The luma is averaged over 2x2 pixels,
    /// and a plane fitted to 8x8 pixels is subtracted, because a plane cannot be matched. The
    /// result is the sum of squares of the rest, averaged over 9 positions in the tile [grey
    /// levels^2].
    float structure = 0;
    /// Mean squares of three quantities that are computed from the change of luma since the tile
    /// was last drawn. `pixels`: twists of 2x2 pixels. `means`: means of 2x2 pixels. `bends`:
    /// twists of 2x2 such means. The twist of four values a b above c d is (a - b - c + d) / 2;
    /// slopes do not change it (after Immerkaer, Fast noise variance estimation, 1996). The three
    /// mean squares are scaled so that they are equal for white noise.
    float pixels = 0, means = 0, bends = 0;
};

struct ChangeBounds {
    /// Largest mean difference and largest mean absolute difference of an unchanged cell [grey
    /// levels].
    float mean, absolute;
    /// Variance of the noise in the means of 2x2 pixels, divided by a quarter of the variance in
    /// single pixels. It is 1 for white noise.
    float grain;
};

/// Measures every tile. `out` is row-major; its values are in [0, 1.1e6]. Both pictures must have
/// the same size. If `workers` is null, the caller's thread does all work. The result does not
/// depend on the number of threads.
void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out);

}  // namespace mfar
