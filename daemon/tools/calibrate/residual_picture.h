#pragma once

#include "daemon/tools/calibrate/solve.h"

#include <filesystem>

namespace mfar::calibration {

/// Writes a PNG file of the calibration's residuals, with two panels for each sensor. The left
/// panel has the shape of the sensor's pictures, and a dot at each place where a corner was found
/// in a used view. The panel is divided into cells. In each cell with at least four corners, an
/// arrow shows the mean residual of these corners. Very long arrows are shortened. The scale below
/// the panel gives the arrows' lengths in pixels. If the lens model fits, the arrows are short and
/// have no common direction. The right panel shows each residual of up to 4.5 standard deviations
/// as a point; the middle of the panel is the residual 0. Throws ImageFileError.
void saveResidualPicture(const std::filesystem::path& file, const Calibration& calibration);

}  // namespace mfar::calibration
