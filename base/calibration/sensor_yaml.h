#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Content of one EuRoC sensor.yaml of a camera.
struct SensorYaml {
    CameraModel camera;
    RigidTransform T_body_sensor;  ///< T_BS: sensor coordinates -> body coordinates
    double rateHz = 0;             ///< 0: on trigger only
};

/// Reads and validates: pinhole model, finite and plausible numbers, T_BS a rotation and a
/// translation, `wanted` size if given. Throws CalibrationError.
[[nodiscard]] SensorYaml readSensorYaml(const std::filesystem::path& file,
                                        std::optional<Size> wanted = {});

/// The text of a sensor.yaml from which readSensorYaml() gets the same numbers to the last bit,
/// except for rounding of the rotation.
[[nodiscard]] std::string sensorYamlText(const SensorYaml& sensor, std::string_view comment);

}  // namespace mfar
