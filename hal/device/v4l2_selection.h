#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/v4l2_device.h"

namespace mfar {

/// Opens the capture device whose path, card name or bus name is wish.name. If that is empty, a
/// device is chosen as in chooseCamera(), with the path as id. Throws a std::runtime_error that
/// lists the devices if no device or several devices match.
[[nodiscard]] V4l2Device openCapture(V4l2Api& api, const CameraWish& wish);

}  // namespace mfar
