#pragma once

#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/workload.h"

namespace mfar::bench {

/// Time per frame of finding depth from a keyframe (an earlier frame) instead of a still: luma,
/// search, filter, and moving depth edges to picture edges. No frame leaves out the search. A
/// summary with 0 runs was not measured.
struct DepthTimes {
    Summary tenth;  ///< search in a tenth of the picture, around its centre
    Summary whole;  ///< search in the whole picture
};

/// Uses only the frames that have a pose. The first six frames warm up and do not count.
[[nodiscard]] DepthTimes measureDepth(const Workload& posed);

}  // namespace mfar::bench
