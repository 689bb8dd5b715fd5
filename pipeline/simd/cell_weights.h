#pragma once

#include "pipeline/engine/cells.h"

#include <array>

namespace mfar::simd {

/// A row of cells and the rows above and below. Each row repeats its border by one cell on both
/// sides, and its memory extends to a multiple of 16 cells.
struct RowsAround {
    const float *above, *here, *below;
};

/// Input for the weights of a row of cells. Covariance and variances are those of PatchSums.
struct WeighRow {
    int count;
    RowsAround flowX, flowY;  ///< [video px]
    RowsAround covariance, varianceVideo, varianceStill;
    const float *confidence, *lookX, *lookY;
    /// Two rows of the field at half resolution: `near` contains the cells, `other` is the one of
    /// its neighbours that is closer to the cells.
    struct Half {
        const float *near, *other;
    };
    Half halfCovariance, halfVarianceStill;
    /// Results; written up to a multiple of 16 cells.
    WeighedCell* weighed;
    LookUpCell* lookUps;
    TrustCell* trust;
};

/// Computes how far the still is trusted at each cell (superres_weigh.comp). `noise`: standard
/// deviation of the video's noise [grey levels].
void weighCells(const WeighRow& row, float noise);

}  // namespace mfar::simd
