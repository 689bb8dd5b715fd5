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

/// Reads and validates: pinhole model, finite and plausible numbers, a T_BS that is a rotation and
/// a translation, the wanted size if there is one. Throws CalibrationError.
[[nodiscard]] SensorYaml readSensorYaml(const std::filesystem::path& file,
                                        std::optional<Size> wanted = {});

/// The text of a sensor.yaml that readSensorYaml() reads back to the last bit but rounding of the
/// rotation.
[[nodiscard]] std::string sensorYamlText(const SensorYaml& sensor, std::string_view comment);

}  // namespace mfar
