#pragma once

#include "pipeline/pipeline.h"

#include <vector>

namespace mfar {

/// An assignment of steps to engines, and the time of a frame with it during camera motion.
struct EngineTrial {
    EngineChoice engines;
    /// Median time, or if the measurement was cut short, the time of one frame. It includes
    /// transfers between CPU and GPU.
    double frameMs = 0;
};

/// Measures the time of a frame with each of the assignments of steps to engines, on generated
/// moving pictures. Returns the assignments with their times, the fastest first. The measurement of
/// an assignment is cut short if its first measured frame takes more than kHopelessFrame times as
/// long as a frame with the fastest assignment so far. `shownFrom`: the display reads the picture
/// from GPU memory (Gles) or from CPU memory (Simd).
///
/// Needs a current GL context. Four assignments take about a second, mostly for compiling shaders.
/// Throws like Pipeline.
[[nodiscard]] std::vector<EngineTrial> tryEngines(const std::vector<EngineChoice>& placements,
                                                  const StereoRig& rig, Size output,
                                                  EngineKind shownFrom);

/// Returns true if no texture of a step exceeds the largest size of the GPU's textures. Needs a
/// current GL context.
[[nodiscard]] bool fitsGpu(const StereoRig& rig, Size output);

/// Returns the size of the path-traced layer, reduced if its textures exceed the GPU's limit. Needs
/// a current GL context.
[[nodiscard]] Size layerOnGpu(Size wanted);

}  // namespace mfar
