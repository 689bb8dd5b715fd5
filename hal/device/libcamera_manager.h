#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/libcamera_compat.h"

#include <memory>
#include <vector>

namespace mfar {

/// Returns the process's libcamera manager, of which libcamera allows only one. It lives as long as
/// a pointer to it exists. It keeps its list of cameras up to date. Throws std::runtime_error.
[[nodiscard]] std::shared_ptr<libcamera::CameraManager> libcameraManager();

/// Describes libcamera's cameras as ListedCamera, in the same order.
[[nodiscard]] std::vector<ListedCamera>
listCameras(const std::vector<std::shared_ptr<libcamera::Camera>>& cameras);

/// Returns the camera that chooseCamera() chooses.
[[nodiscard]] std::shared_ptr<libcamera::Camera>
findLibcamera(const libcamera::CameraManager& manager, const CameraWish& wish);

}  // namespace mfar
