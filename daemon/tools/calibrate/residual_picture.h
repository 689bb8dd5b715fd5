#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <filesystem>

namespace mfar::calibration {

/// A PNG of what the calibration leaves unexplained, a row for each sensor. Left the picture's
/// area: every corner a dot, the mean residual of each cell an arrow, magnified as the scale says;
/// where the lens model fits, the arrows are short and have no order. Right all residuals around
/// zero. Throws ImageFileError.
void saveResidualPicture(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace mfar::calibration
