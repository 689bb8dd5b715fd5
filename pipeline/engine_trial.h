#pragma once

#include "pipeline/pipeline.h"

#include <vector>

namespace mfar {

/// One way to place the steps, and what a moving frame takes with it.
struct EngineTrial {
    EngineChoice engines;
    double frameMs = 0;  ///< median; transfers between host and GPU included
};

/// Measures placements on moving pictures made in code; one that proves to be over twice as slow as
/// the fastest so far is measured no further. `shownFrom`: where the display takes the picture
/// from. Fastest first. Needs a current GL context; takes about a second for four, most of it for
/// compiling shaders. Throws as Pipeline does.
[[nodiscard]] std::vector<EngineTrial> tryEngines(const std::vector<EngineChoice>& placements,
                                                  const StereoRig& rig, Size output,
                                                  EngineKind shownFrom);

}  // namespace mfar
