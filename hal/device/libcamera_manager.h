#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/libcamera_compat.h"

#include <memory>
#include <vector>

namespace mfar {

/// libcamera allows one manager in a process. It lives as long as somebody holds it, and keeps its
/// list of cameras by itself while they come and go. Throws std::runtime_error.
[[nodiscard]] std::shared_ptr<libcamera::CameraManager> libcameraManager();

/// As ListedCamera, in the order of the manager.
[[nodiscard]] std::vector<ListedCamera>
listCameras(const std::vector<std::shared_ptr<libcamera::Camera>>& cameras);

/// See chooseCamera().
[[nodiscard]] std::shared_ptr<libcamera::Camera>
findLibcamera(const libcamera::CameraManager& manager, const CameraWish& wish);

}  // namespace mfar
