#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <filesystem>

namespace mfar::calibration {

/// Writes a PNG file of the calibration's residuals, with one row for each sensor. The left panel
/// is the area of the sensor's picture, with a dot for each corner. Each cell has an arrow for its
/// mean residual, enlarged as the scale shows. Where the lens model fits, arrows are short and have
/// no pattern. The right panel shows all residuals as points around zero. Throws ImageFileError.
void saveResidualPicture(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace mfar::calibration
