#pragma once

#include "daemon/tools/calibrate/coverage.h"
#include "daemon/tools/calibrate/solve.h"

#include <string>

namespace mfar::calibration {

/// Returns the coverage map with a border and a title.
[[nodiscard]] std::string mapText(const Coverage& coverage, const std::string& title);

/// Returns a list of all views with their reprojection errors. Views that were not used are marked.
[[nodiscard]] std::string viewsText(const Calibration& calibration);

/// Returns a list of the calibrated parameters, their standard deviations and the remaining errors.
[[nodiscard]] std::string resultText(const Calibration& calibration);

}  // namespace mfar::calibration
