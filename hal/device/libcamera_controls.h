#pragma once

#include "hal/device/libcamera_compat.h"

#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Names and values as text: "ExposureTime" "8000", "AfMode" "0" or, since libcamera 0.4, the name
/// of a value; several values of an array separated by commas.
using NamedValues = std::vector<std::pair<std::string, std::string>>;
/// Keyed by libcamera's control number.
using ControlValues = std::vector<std::pair<unsigned, libcamera::ControlValue>>;

[[nodiscard]] bool hasControl(const libcamera::ControlInfoMap& camera, const std::string& name);

/// Looks the names up in the camera's controls, so vendors' controls work too. Throws
/// std::runtime_error: an unknown name lists the camera's controls, an invalid value reports type
/// and range.
[[nodiscard]] ControlValues parseControls(const libcamera::ControlInfoMap& camera,
                                          const NamedValues& wanted);

}  // namespace mfar
