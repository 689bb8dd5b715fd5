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

/// Compares doubtful cells [first, end) of a row with the still itself, see params::kPatchSamples.
/// `flow` and `errors` are the fields of all cells. A cell gets the flow along its epipolar line if
/// that fits clearly better. If the comparison finds a better match than FlowCell::cost shows, it
/// also gets the sums in ErrorCell, and its two-way error is at most the one of such a match. CPU
/// version of flow_direct.comp.
void matchDirectly(const DirectMatch& in, int row, int first, int end, FlowCell* flow,
                   ErrorCell* errors);

}  // namespace mfar::simd
