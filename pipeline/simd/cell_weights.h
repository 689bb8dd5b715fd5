#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"

#include <array>

namespace mfar::simd {

/// A row of cells and the rows above and below. Each row has one more cell on both sides, which
/// repeats the outermost cell. A row's memory extends to a multiple of 16 cells.
struct RowsAround {
    const float *above, *here, *below;
};

/// Input and results of weighCells() for a row of `count` cells. flowX, flowY: flow [video px].
/// lookX, lookY: LookUpCell::x and y. Covariance and variances: see PatchSums.
struct WeighRow {
    int count;
    RowsAround flowX, flowY;
    const float *flowX2, *flowY2;  ///< two rows below
    RowsAround covariance, varianceVideo, varianceStill;
    const float *confidence, *lookX, *lookY;
    /// Two rows of patch statistics at half resolution. `near` is the row that contains the cells.
    /// `other` is the row above or below `near`, whichever is closer to the cells.
    struct Half {
        const float *near, *other;
    };
    Half halfCovariance, halfVarianceStill;
    /// Results, with room for a multiple of 16 cells: the kernel also writes entries after `count`.
    WeighedCell* weighed;
    LookUpCell* lookUps;
    TrustCell* trust;
    float *kink, *variance;  ///< see SurfaceCells
};

/// Properties of each cell on which the comparison of the finest detail depends; see
/// params::kFineRoom.
struct SurfaceCells {
    Rows<const float> kink;      ///< second difference of bent flow [px], see params::kFlatKink
    Rows<const float> variance;  ///< variance of the video's luma around the cell [grey levels^2]
};

/// Computes the weight of the still's detail at each cell, as superres_weigh.comp does. `noise`:
/// standard deviation of the video's noise [grey levels].
void weighCells(const WeighRow& row, float noise);

}  // namespace mfar::simd
