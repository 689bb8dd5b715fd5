#pragma once

#include "base/progress.h"
#include "pipeline/engine/engine.h"
#include "tests/measure/bench/summary.h"
#include "tests/measure/bench/workload.h"

namespace mfar::bench {

/// Frame times with a path-traced model in view, at up to 30 frames per second with a moving
/// camera. All frames show a picture of the first frame's view, warped.
struct ObjectTimes {
    Summary tracing;  ///< the path tracer adds samples to the picture, with mfard's default budget
    Summary waiting;  ///< the picture is finished, and the path tracer has no work
};

/// Measures both kinds of frames (ObjectTimes::tracing and ObjectTimes::waiting) in turn, so that
/// both see the same load of the machine. Places the model showpiece() in front of the first
/// frame's camera. Returns empty summaries if the build has no path tracer, or if `posed` has no
/// frames or no pose of the first frame.
[[nodiscard]] ObjectTimes measureObjects(const Workload& posed, EngineKind engine,
                                         const ProgressPart& progress);

}  // namespace mfar::bench
