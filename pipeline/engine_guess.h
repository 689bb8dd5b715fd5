#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// An assignment of steps to engines is discarded if a frame takes more than kHopelessFrame times
/// as long as with the fastest assignment.
inline constexpr double kHopelessFrame = 2;

/// Returns the assignments of steps to engines that may be the fastest while the camera moves, the
/// most promising first. Either one engine runs all steps, or one engine runs matching (pyramid,
/// flow, weigh) and the other drawing (still, detail, occlusion).
///
/// For some GPUs, the time of each assignment is known from `./run board-report`. Assignments that
/// should take more than kHopelessFrame times as long as the fastest are left out. (The factor is
/// large, because predictions may be wrong by a factor of two.) `driver` is
/// GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
