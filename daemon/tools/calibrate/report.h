#pragma once

#include "daemon/tools/calibrate/coverage.h"
#include "daemon/tools/calibrate/solve.h"

#include <string>

namespace mfar::calibration {

[[nodiscard]] std::string mapText(const Coverage& coverage, const std::string& title);

[[nodiscard]] std::string viewsText(const Calibration& calibration);

[[nodiscard]] std::string resultText(const Calibration& calibration);

}  // namespace mfar::calibration
