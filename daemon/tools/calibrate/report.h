#pragma once

#include "daemon/tools/calibrate/coverage.h"
#include "daemon/tools/calibrate/solve.h"

#include <string>

namespace mfar::calibration {

/// The coverage map in a frame, with the title above it.
[[nodiscard]] std::string mapText(const Coverage& coverage, const std::string& title);

/// The reprojection error of every view, with a mark at views that were left out.
[[nodiscard]] std::string viewsText(const Calibration& calibration);

/// Parameters with their standard deviations and the remaining errors.
[[nodiscard]] std::string resultText(const Calibration& calibration);

}  // namespace mfar::calibration
