#pragma once

#include "daemon/run_history.h"

#include <string>

namespace mfar {

/// Draws charts of the run as SVG elements: frame time and latency, rate and drops, late frames,
/// confidence and tracked share, stills, learning. A chart without any values is left out.
/// `deadlineMs` is 0 if there is no deadline.
[[nodiscard]] std::string runCharts(const RunHistory& history, double deadlineMs);

/// Draws a chart for each stage: the median and the 95 % quantile of its time.
[[nodiscard]] std::string stageCharts(const RunHistory& history);

}  // namespace mfar
