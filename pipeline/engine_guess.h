#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// An assignment of steps to engines is discarded if a frame takes more than this factor times a
/// frame with the fastest assignment.
inline constexpr double kHopelessFrame = 2;

/// Returns the assignments of steps to engines that may be the fastest during camera motion, the
/// most promising first. Either one engine runs all steps, or one engine runs matching (pyramid,
/// flow, weigh) and the other drawing (still, detail, occlusion).
///
/// Excludes those that take longer than kHopelessFrame times the fastest, according to the
/// predictions of `./run board-report` for this GPU. They may be wrong by a factor of two. `driver`
/// is GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
