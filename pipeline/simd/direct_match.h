#pragma once

#include "base/rows.h"
#include "pipeline/engine/cells.h"
#include "pipeline/plan/rgb_planes.h"
#include "pipeline/simd/detail_kernels.h"
#include "pipeline/simd/still_look_up.h"

#include <array>

namespace mfar::simd {

/// Input of matchDirectly(). Arrays with one entry per cell are row-major without gaps.
struct DirectMatch {
    const RgbPlanes& video;
    const StillPairs& still;
    const LookUpParams& lookUp;
    Size cells;
    const std::array<float, 4>* lines;  ///< flow along epipolar lines: x, y [px], two unused
    float noise;                        ///< standard deviation of the video's noise [grey levels]
    /// Only cells whose FlowCell::texture exceeds this are compared [grey levels^2].
    float leastTexture;
};

/// Corrects the flow of doubtful cells by comparing the video with the full-resolution still; see
/// params::kPatchSamples. (The flow search compares the video with a still that is reduced to the
/// video's resolution.) Processes the cells [first, end) of a row; `flow` and `errors` contain all
/// cells of the frame. CPU version of flow_direct.comp.
///
/// A cell's flow is replaced by its flow along the epipolar line if the still fits clearly better
/// there. If the correlation with the still exceeds 1 - FlowCell::cost, the sums of this comparison
/// are stored in the cell's ErrorCell, and the cell's two-way error is limited to the error that
/// params::kErrorPerCost gives for the cost 1 - correlation.
void matchDirectly(const DirectMatch& in, int row, int first, int end, FlowCell* flow,
                   ErrorCell* errors);

}  // namespace mfar::simd
