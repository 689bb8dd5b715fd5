#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/v4l2_device.h"

namespace mfar {

/// Opens the capture device with this path, card name or bus name. If the name is empty, a device
/// is chosen as in chooseCamera(), with the path as id. Throws a std::runtime_error that lists the
/// devices if none or several match.
[[nodiscard]] V4l2Device openCapture(V4l2Api& api, const CameraWish& wish);

}  // namespace mfar
