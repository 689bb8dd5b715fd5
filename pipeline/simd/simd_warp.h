#pragma once

#include "base/workers.h"
#include "pipeline/engine/field.h"
#include "pipeline/warp/warp_options.h"
#include "pipeline/warp/warp_step.h"

#include <memory>

namespace mfar::simd {

/// Creates the warp step on the CPU. Null workers: all work runs in the caller's thread.
[[nodiscard]] std::unique_ptr<WarpStep> makeWarpStep(const CameraModel& layer,
                                                     const WarpOptions& options,
                                                     std::shared_ptr<Workers> workers,
                                                     Transfers* transfers);

}  // namespace mfar::simd
