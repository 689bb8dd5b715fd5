#pragma once

#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/workload.h"

namespace mfar::bench {

/// Time per frame to find depth from a keyframe (an earlier frame) instead of a still. It includes
/// all steps: luma, search, filter, and moving depth edges to picture edges. Depth is searched in
/// every frame. If `runs` of a summary is 0, it was not measured.
struct DepthTimes {
    Summary tenth;  ///< search in a tenth of the picture, around its centre
    Summary whole;
};

/// Uses only frames with poses. The first six frames warm up and are not counted.
[[nodiscard]] DepthTimes measureDepth(const Workload& posed);

}  // namespace mfar::bench
