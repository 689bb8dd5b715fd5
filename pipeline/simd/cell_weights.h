#pragma once

#include "pipeline/engine/cells.h"

#include <array>

namespace mfar::simd {

/// A row of cells and its neighbours. Each repeats its border 1 cell to the left and to the right,
/// and its memory extends to a multiple of 16 cells.
struct RowsAround {
    const float *above, *here, *below;
};

/// Input for the weights of a row of cells. Statistics are those of PatchSums.
struct WeighRow {
    int count;
    RowsAround flowX, flowY;  ///< [video px]
    RowsAround covariance, varianceVideo, varianceStill;
    const float *confidence, *lookX, *lookY;
    /// At half resolution: the row that contains the cells, and the nearer of its neighbours.
    struct Half {
        const float *near, *other;
    };
    Half halfCovariance, halfVarianceStill;
    /// Written up to a multiple of 16 cells.
    WeighedCell* weighed;
    LookUpCell* lookUps;
    TrustCell* trust;
};

/// How far the still is trusted (superres_weigh.comp). `noise`: standard deviation of the video's
/// noise [grey levels].
void weighCells(const WeighRow& row, float noise);

}  // namespace mfar::simd
