#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// A placement whose frame takes longer is hopeless: times the fastest's.
inline constexpr double kHopelessFrame = 2;

/// The placements that can pay on moving pictures, the most promising first: all steps on one
/// engine, or matching (pyramid, flow, weigh) on the other than drawing (still, detail, occlusion).
/// Those that `./run board-report` predicts to be hopeless on this GPU are left out; its
/// predictions may be off by a factor of two. `driver`: GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
