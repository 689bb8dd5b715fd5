#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// A placement is not tried if its predicted frame time exceeds the fastest prediction by this
/// factor.
inline constexpr double kHopelessFrame = 2;

/// Placements of the steps that may be the fastest while the camera moves, the most promising
/// first. Either all steps run on one engine, or matching (pyramid, flow, weigh) runs on one engine
/// and drawing (still, detail, occlusion) on the other.
/// Placements are excluded if `./run board-report` predicts for this GPU that they are slower than
/// the fastest by kHopelessFrame. The predictions may be wrong by a factor of two. `driver` is
/// GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
