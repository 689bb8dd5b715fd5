#pragma once

#include "daemon/tools/calibrate/coverage.h"
#include "daemon/tools/calibrate/solve.h"

#include <string>

namespace mfar::calibration {

/// The map in a frame, with the title above it.
[[nodiscard]] std::string mapText(const Coverage& coverage, const std::string& title);

/// The reprojection error of every view, and which ones were left out.
[[nodiscard]] std::string viewsText(const Calibration& calibration);

/// Parameters with their standard deviations and the errors that are left.
[[nodiscard]] std::string resultText(const Calibration& calibration);

}  // namespace mfar::calibration
