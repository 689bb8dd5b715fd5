#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// An assignment of steps to engines is discarded if a frame takes more than this factor times as
/// long as with the fastest assignment.
inline constexpr double kHopelessFrame = 2;

/// Returns the assignments of steps to engines that may be the fastest during camera motion, the
/// most promising first. Either one engine runs all steps, or one engine runs matching (pyramid,
/// flow, weigh) and the other drawing (still, detail, occlusion).
///
/// `./run board-report` has predicted the times for some GPUs. An assignment is left out if its
/// predicted time exceeds kHopelessFrame times the predicted time of the fastest assignment.
/// (Predictions may be wrong by a factor of two.) `driver` is GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
