#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/v4l2_device.h"

namespace mfar {

/// Opens a capture device by its path, or by a card or bus name that belongs to one node; an empty
/// name works as in chooseCamera(), with the path as id. Throws std::runtime_error that lists the
/// devices when none or several match.
[[nodiscard]] V4l2Device openCapture(V4l2Api& api, const CameraWish& wish);

}  // namespace mfar
