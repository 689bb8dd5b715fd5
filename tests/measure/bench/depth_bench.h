#pragma once

#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/workload.h"

namespace mfar::bench {

/// Time per frame of finding depth without a still: luma, search against a keyframe, filter and
/// edges. The options make every frame search. A summary of zero runs: not measured.
struct DepthTimes {
    Summary tenth;  ///< search in a tenth of the picture, around its centre
    Summary whole;  ///< search in the whole picture
};

/// Uses only the frames that have a pose. The first of them warm up and do not count.
[[nodiscard]] DepthTimes measureDepth(const Workload& posed);

}  // namespace mfar::bench
