#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <filesystem>

namespace mfar::calibration {

/// Writes a PNG file of the calibration's residuals, with two panels for each sensor. The left
/// panel has the shape of the sensor's pictures, and a dot at each place where a corner was found
/// in any of them. It is divided into cells. In each cell, an arrow shows the mean residual of the
/// cell's corners. The scale below the panel gives the arrows' lengths in pixels. If the lens model
/// fits, the arrows are short and have no common direction. The right panel shows each residual as
/// a point; the middle of the panel is the residual 0. Throws ImageFileError.
void saveResidualPicture(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace mfar::calibration
