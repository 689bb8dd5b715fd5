#pragma once

#include "daemon/run_history.h"

#include <string>

namespace mfar {

/// Draws charts of the run as SVG elements: frame time and latency, rate and drops, late frames,
/// confidence and share of frames with a pose, stills, learning. Without a deadline (`deadlineMs`
/// is 0), there is no chart of late frames. If no filters were learned, there is no chart of
/// learning.
[[nodiscard]] std::string runCharts(const RunHistory& history, double deadlineMs);

[[nodiscard]] std::string stageCharts(const RunHistory& history);

}  // namespace mfar
