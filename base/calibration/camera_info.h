#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Reads a ROS camera_info file as camera_calibration_parsers writes it. The lens model must be
/// plumb_bob, or rational_polynomial with a denominator of 1. The picture size must equal `wanted`
/// if that is set. Throws CalibrationError.
[[nodiscard]] CameraModel readCameraInfo(const std::filesystem::path& file,
                                         std::optional<Size> wanted = {});

[[nodiscard]] std::string cameraInfoText(const CameraModel& camera, std::string_view name);

}  // namespace mfar
