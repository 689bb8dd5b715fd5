#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/v4l2_device.h"

namespace mfar {

/// Opens the capture device whose path, card name or bus name is wish.name. If the name is empty,
/// chooses a device like chooseCamera(), with the path as id. Throws std::runtime_error if no
/// device or several devices match. The message lists the devices, unless wish.name is a path.
[[nodiscard]] V4l2Device openCapture(V4l2Api& api, const CameraWish& wish);

}  // namespace mfar
