#pragma once

#include "base/calibration/calibration_error.h"
#include "base/geometry.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

/// Content of a camera's sensor.yaml in EuRoC's format.
struct SensorYaml {
    CameraModel camera;
    RigidTransform T_body_sensor;  ///< T_BS: sensor coordinates -> body coordinates
    double rateHz = 0;             ///< 0: pictures on trigger only, or no rate_hz in the file
    double timeOffset = 0;         ///< was added to the camera's times [s]; 0: no time_offset
};

/// Reads a sensor.yaml. Throws CalibrationError if the model is not a pinhole camera, a number is
/// not finite or not plausible, T_BS is not a rigid transform, or the size differs from `wanted`.
[[nodiscard]] SensorYaml readSensorYaml(const std::filesystem::path& file,
                                        std::optional<Size> wanted = {});

/// Returns the text of a sensor.yaml. readSensorYaml() reads exactly the same numbers from it,
/// except for rounding of the rotation.
[[nodiscard]] std::string sensorYamlText(const SensorYaml& sensor, std::string_view comment);

}  // namespace mfar
