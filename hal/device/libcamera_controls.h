#pragma once

#include "hal/device/libcamera_compat.h"

#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Names and values as text: "ExposureTime" "8000", "AfMode" "0" or, since libcamera 0.4, the name
/// of a value; several values of an array separated by commas.
using NamedValues = std::vector<std::pair<std::string, std::string>>;
/// By libcamera's number.
using ControlValues = std::vector<std::pair<unsigned, libcamera::ControlValue>>;

[[nodiscard]] bool hasControl(const libcamera::ControlInfoMap& camera, const std::string& name);

/// Looks the names up in what the camera has, so vendors' controls work too. Throws
/// std::runtime_error that lists the camera's controls for an unknown name, and that says type and
/// range for a value that is not of them.
[[nodiscard]] ControlValues parseControls(const libcamera::ControlInfoMap& camera,
                                          const NamedValues& wanted);

}  // namespace mfar
