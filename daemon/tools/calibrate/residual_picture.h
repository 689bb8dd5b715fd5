#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <filesystem>

namespace mfar::calibration {

/// A PNG of the calibration's residuals, a row for each sensor. Left: the picture's area, a dot for
/// every corner and an arrow for the mean residual of each cell, enlarged as the scale shows; where
/// the lens model fits, the arrows are short and without a pattern. Right: all residuals around
/// zero. Throws ImageFileError.
void saveResidualPicture(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace mfar::calibration
