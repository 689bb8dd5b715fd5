#pragma once

#include "daemon/run_history.h"

#include <string>

namespace mfar {

/// Draws charts of the run as SVG elements: frame time and latency, rate and drops, late frames,
/// confidence and tracked share, stills, learning. A chart without values is omitted. `deadlineMs`
/// 0: there is no deadline.
[[nodiscard]] std::string runCharts(const RunHistory& history, double deadlineMs);

[[nodiscard]] std::string stageCharts(const RunHistory& history);

}  // namespace mfar
