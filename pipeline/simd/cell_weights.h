#pragma once

#include "pipeline/engine/cells.h"

#include <array>

namespace mfar::simd {

/// Rows around a row of cells. Each repeats its border 1 cell to the left and to the right, and its
/// memory goes on to a multiple of 16 cells.
struct RowsAround {
    const float *above, *here, *below;
};

/// What a row of cells is weighed by. Statistics are those of PatchSums.
struct WeighRow {
    int count;
    RowsAround flowX, flowY;  ///< [video px]
    RowsAround covariance, varianceVideo, varianceStill;
    const float *confidence, *lookX, *lookY;
    /// At half resolution: the cell's row and the one beside it that is nearer.
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
