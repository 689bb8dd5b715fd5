#pragma once

#include "pipeline/pipeline.h"

#include <vector>

namespace mfar {

/// A placement of the steps and its measured time for a moving frame.
struct EngineTrial {
    EngineChoice engines;
    double frameMs = 0;  ///< median, including transfers between host and GPU
};

/// Measures placements on generated moving pictures; a placement that proves over twice as slow as
/// the fastest so far is stopped early. `shownFrom`: where the display takes the picture from.
/// Fastest first. Needs a current GL context; takes about a second for four placements, mostly for
/// compiling shaders. Throws as Pipeline does.
[[nodiscard]] std::vector<EngineTrial> tryEngines(const std::vector<EngineChoice>& placements,
                                                  const StereoRig& rig, Size output,
                                                  EngineKind shownFrom);

}  // namespace mfar
