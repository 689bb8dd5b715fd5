#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/detail_kernels.h"
#include "pipeline/simd/still_look_up.h"

#include <array>

namespace mfar::simd {

/// Input of matchDirectly(). All fields of cells have no gaps between rows.
struct DirectMatch {
    const RgbPlanes& video;
    const StillPairs& still;
    const LookUpParams& lookUp;
    Size cells;
    const std::array<float, 4>* lines;  ///< flow along epipolar lines: x, y [px], two unused
    float noise;                        ///< standard deviation [grey levels]
    float leastTexture;                 ///< smallest FlowCell::texture for which the cost counts
};

/// Compares doubtful cells of a row with the still itself instead of its reduction, see
/// params::kPatchSamples. Only cells [first, end) are compared; `flow` and `errors` are the fields
/// of all cells. The flow along its epipolar line replaces a cell's flow if the still fits clearly
/// better there. If the correlation with the still itself exceeds 1 - FlowCell::cost, the cell's
/// ErrorCell gets the sums of this comparison. Its two-way error is then at most the one that
/// params::kErrorPerCost gives for the cost 1 - correlation. CPU version of flow_direct.comp.
void matchDirectly(const DirectMatch& in, int row, int first, int end, FlowCell* flow,
                   ErrorCell* errors);

}  // namespace mfar::simd
