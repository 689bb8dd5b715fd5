#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// An assignment of steps to engines is hopeless if a frame takes more than kHopelessFrame times as
/// long as with the fastest assignment. It is not tried if predictions show this. If only its trial
/// shows this, the trial is cut short.
inline constexpr double kHopelessFrame = 2;

/// Returns the assignments of steps to engines that may be the fastest while the camera moves, the
/// most promising first. Either one engine runs all steps, or one engine runs matching (pyramid,
/// flow, weigh) and the other drawing (still, detail, occlusion).
///
/// For some GPUs, `./run board-report` has predicted the time of a frame with each assignment. An
/// assignment is left out if this time is more than kHopelessFrame times that of the fastest. (The
/// factor is large, because predictions may be wrong by a factor of two.) `driver` is
/// GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
