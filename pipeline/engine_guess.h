#pragma once

#include "pipeline/engine/engine.h"

#include <string_view>
#include <vector>

namespace mfar {

/// A placement of the steps (which engine runs which step) is given up if a frame takes longer with
/// it than this factor times a frame with the fastest placement.
inline constexpr double kHopelessFrame = 2;

/// Placements of the steps that may be the fastest while the camera moves, the most promising
/// first. Either all steps run on one engine, or matching (pyramid, flow, weigh) runs on one engine
/// and drawing (still, detail, occlusion) on the other.
/// Placements are excluded if `./run board-report` predicts for this GPU that they take longer than
/// kHopelessFrame times the fastest. The predictions may be wrong by a factor of two. `driver` is
/// GlContext::description().
[[nodiscard]] std::vector<EngineChoice> promisingEngines(std::string_view driver);

}  // namespace mfar
