#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Reads a ROS camera_info file as camera_calibration_parsers writes it: model plumb_bob, or
/// rational_polynomial whose denominator is 1. `wanted`: the only size that is accepted. Throws
/// CalibrationError.
[[nodiscard]] CameraModel readCameraInfo(const std::filesystem::path& file,
                                         std::optional<Size> wanted = {});

/// The text of a camera_info file from which readCameraInfo() gets the same numbers to the last
/// bit.
[[nodiscard]] std::string cameraInfoText(const CameraModel& camera, std::string_view name);

}  // namespace mfar
