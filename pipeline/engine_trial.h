#pragma once

#include "pipeline/pipeline.h"

#include <vector>

namespace mfar {

/// A placement of the steps and the measured time of a frame while the camera moves.
struct EngineTrial {
    EngineChoice engines;
    double frameMs = 0;  ///< median; includes transfers between CPU and GPU
};

/// Measures the placements on generated moving pictures, and returns them with the fastest first. A
/// placement is stopped early if it takes more than twice as long as the fastest so far.
/// `shownFrom` is where the display takes the picture from.
/// Needs a current GL context. Four placements take about a second, mostly for compiling shaders.
/// Throws like Pipeline.
[[nodiscard]] std::vector<EngineTrial> tryEngines(const std::vector<EngineChoice>& placements,
                                                  const StereoRig& rig, Size output,
                                                  EngineKind shownFrom);

}  // namespace mfar
