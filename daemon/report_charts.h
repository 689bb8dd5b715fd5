#pragma once

#include "daemon/run_history.h"

#include <string>

namespace mfar {

/// Draws charts of the run as SVG elements: frame time and latency, rate and drops, late frames,
/// confidence and tracked share, stills, learning. The chart of late frames is omitted without a
/// deadline (`deadlineMs` is 0), the chart of learning if no filters were learned.
[[nodiscard]] std::string runCharts(const RunHistory& history, double deadlineMs);

[[nodiscard]] std::string stageCharts(const RunHistory& history);

}  // namespace mfar
