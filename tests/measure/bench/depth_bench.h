#pragma once

#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/workload.h"

namespace mfar::bench {

/// Depth without a still, a frame: luma, search against a keyframe, filter and edges. Options are
/// such that every frame is searched. Nothing measured: no runs.
struct DepthTimes {
    Summary tenth;  ///< of the picture, about its middle
    Summary whole;  ///< picture
};

/// Uses the workload's frames that have a pose; the first ones warm up and do not count.
[[nodiscard]] DepthTimes measureDepth(const Workload& posed);

}  // namespace mfar::bench
