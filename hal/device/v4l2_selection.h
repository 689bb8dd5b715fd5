#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/v4l2_device.h"

namespace mfar {

/// Opens a capture device of this machine by its path, or the card or bus of one node; without a
/// name as chooseCamera() does, by path where it says id. Throws std::runtime_error that lists what
/// there is when none or several fit.
[[nodiscard]] V4l2Device openCapture(V4l2Api& api, const CameraWish& wish);

}  // namespace mfar
