#pragma once

#include "base/workers.h"
#include "pipeline/plan/rgb_planes.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Measurements that decide whether a tile of the video differs from the picture that it was last
/// drawn from.
struct TileMeasure {
    /// A cell's mean difference exceeds its noise, or its mean absolute difference does (fine
    /// structure that moved), or the tile's mean and slopes do. The channel that differs most
    /// counts. Changes that are too weak for one tile are found over many, by markDrifted().
    bool changed = false;
    /// The cells of 4x4 pixels whose own differences exceed the thresholds, one bit each,
    /// row-major.
    std::uint16_t changedCells = 0;
    float noise = 0;  ///< standard deviation of the video's noise [grey levels]
    /// Sum of squares of the luma's 2x2 means after a plane is fitted to 8x8 pixels and subtracted;
    /// mean over 9 positions in the tile. A plane alone cannot be matched.
    float structure = 0;
    /// Mean squares of the luma's difference, each scaled to the noise's variance if the noise is
    /// white: of the pixels' twist, of 2x2 means, of the means' twist. The twist of 2x2 values is
    /// (a - b - c + d) / 2 and blind to slopes (after Immerkaer, Fast noise variance estimation,
    /// 1996).
    float pixels = 0, means = 0, bends = 0;
};

/// Thresholds above which a tile certainly changed.
struct ChangeBounds {
    float mean, absolute;  ///< of a cell's differences [grey levels]
    float grain;           ///< noise variance of 2x2 means in quarters of a pixel's
};

/// Measures every tile, row-major, values 0..1.1e6. Both pictures have the same size. Null
/// `workers`: in this thread; the result does not depend on their number.
void measureTiles(const RgbPlanes& now, const RgbPlanes& drawn, const ChangeBounds& bounds,
                  Workers* workers, std::vector<TileMeasure>& out);

}  // namespace mfar
