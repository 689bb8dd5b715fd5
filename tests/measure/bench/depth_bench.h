#pragma once

#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/workload.h"

namespace mfar::bench {

/// Time of depth without a still, per frame: luma, search against a keyframe, filter and edges. The
/// options make every frame search. Not measured: zero runs.
struct DepthTimes {
    Summary tenth;  ///< of the picture, around its centre
    Summary whole;  ///< the whole picture
};

/// Uses the workload's frames that have a pose; the first ones warm up and do not count.
[[nodiscard]] DepthTimes measureDepth(const Workload& posed);

}  // namespace mfar::bench
