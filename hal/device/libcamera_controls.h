#pragma once

#include "hal/device/libcamera_compat.h"

#include <string>
#include <utility>
#include <vector>

namespace mfar {

/// Names and values of controls as text: "ExposureTime" and "8000", "AfMode" and "0". Since
/// libcamera 0.4, a value may be given by its name: "AfModeManual" instead of "0". The values of an
/// array are separated by commas.
using NamedValues = std::vector<std::pair<std::string, std::string>>;
using ControlValues = std::vector<std::pair<unsigned, libcamera::ControlValue>>;

[[nodiscard]] bool hasControl(const libcamera::ControlInfoMap& camera, const std::string& name);

/// If `wanted` sets exposure, gain or focus but not its mode, adds the control that makes the mode
/// manual, because drivers ignore the value in automatic mode. Before libcamera 0.5, exposure and
/// gain share one mode, which becomes manual only if `wanted` sets both.
[[nodiscard]] NamedValues withManualModes(const libcamera::ControlInfoMap& camera,
                                          NamedValues wanted);

/// Converts names and texts to control values, also for controls of the camera's vendor. Throws
/// std::runtime_error if a name is unknown (the message lists the controls) or a value is invalid
/// (the message states the range).
[[nodiscard]] ControlValues parseControls(const libcamera::ControlInfoMap& camera,
                                          const NamedValues& wanted);

}  // namespace mfar
