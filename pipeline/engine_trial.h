#pragma once

#include "pipeline/pipeline.h"

#include <vector>

namespace mfar {

/// A placement of the steps (which engine runs which step), and the time that a frame takes with it
/// while the camera moves.
struct EngineTrial {
    EngineChoice engines;
    double frameMs = 0;  ///< median; includes transfers between CPU and GPU
};

/// Measures the placements on generated moving pictures, and returns them with the fastest first.
/// The measurement of a placement ends early if its frame takes more than kHopelessFrame times as
/// long as with the fastest placement so far. `shownFrom`: whether the display shows the picture
/// from GPU memory (Gles) or from CPU memory (Simd).
/// Needs a current GL context. Four placements take about a second, mostly for compiling shaders.
/// Throws like Pipeline.
[[nodiscard]] std::vector<EngineTrial> tryEngines(const std::vector<EngineChoice>& placements,
                                                  const StereoRig& rig, Size output,
                                                  EngineKind shownFrom);

}  // namespace mfar
