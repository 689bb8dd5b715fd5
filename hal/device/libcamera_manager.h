#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/libcamera_compat.h"

#include <memory>
#include <vector>

namespace mfar {

/// The process's only libcamera manager (libcamera allows just one). It lives while somebody holds
/// it and updates its list of cameras itself. Throws std::runtime_error.
[[nodiscard]] std::shared_ptr<libcamera::CameraManager> libcameraManager();

/// The manager's cameras as ListedCamera, in its order.
[[nodiscard]] std::vector<ListedCamera>
listCameras(const std::vector<std::shared_ptr<libcamera::Camera>>& cameras);

/// See chooseCamera().
[[nodiscard]] std::shared_ptr<libcamera::Camera>
findLibcamera(const libcamera::CameraManager& manager, const CameraWish& wish);

}  // namespace mfar
