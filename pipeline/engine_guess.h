#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// A placement is hopeless if its frame takes longer than this factor times the fastest one's.
inline constexpr double kHopelessFrame = 2;

/// Placements that may be the fastest for moving pictures, the most promising first: all steps on
/// one engine, or matching (pyramid, flow, weigh) on one engine and drawing (still, detail,
/// occlusion) on the other. Excludes those that `./run board-report` predicts to be hopeless on
/// this GPU; its predictions may be off by a factor of two. `driver`: GlContext::description().
/// predictions may be off by a factor of two. `driver`: GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
