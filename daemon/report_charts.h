#pragma once

#include "daemon/run_history.h"

#include <string>

namespace mfar {

/// The course of the run as SVG elements: frame time and latency, rate and drops, late frames,
/// confidence and tracked share, stills, learning. Charts that have nothing to show are left out.
/// `deadlineMs`: 0 without a deadline.
[[nodiscard]] std::string runCharts(const RunHistory& history, double deadlineMs);

/// One chart of median and 95 % quantile for each stage.
[[nodiscard]] std::string stageCharts(const RunHistory& history);

}  // namespace mfar
