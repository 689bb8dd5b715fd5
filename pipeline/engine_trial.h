#pragma once

#include "pipeline/pipeline.h"

#include <vector>

namespace mfar {

/// One way to place the steps, and what a moving frame takes with it.
struct EngineTrial {
    EngineChoice engines;
    double frameMs = 0;  ///< median; transfers between host and GPU included
};

/// Measures the placements that can pay on moving pictures made in code: all steps on one engine,
/// and matching (pyramid, flow, weigh) on the other than drawing (still, detail, occlusion).
/// `shownFrom`: where the display takes the picture from. Fastest first. Needs a current GL
/// context; takes about a second, most of it for compiling shaders. Throws as Pipeline does.
[[nodiscard]] std::vector<EngineTrial> tryEngines(const StereoRig& rig, Size output,
                                                  EngineKind shownFrom);

}  // namespace mfar
