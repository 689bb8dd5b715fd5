#pragma once

#include "hal/device/camera_selection.h"
#include "hal/device/libcamera_compat.h"

#include <memory>
#include <vector>

namespace mfar {

/// Returns the only libcamera manager of this process, because libcamera does not allow a second
/// one. It lives as long as a pointer to it exists. Throws std::runtime_error.
[[nodiscard]] std::shared_ptr<libcamera::CameraManager> libcameraManager();

[[nodiscard]] std::vector<ListedCamera>
listCameras(const std::vector<std::shared_ptr<libcamera::Camera>>& cameras);

[[nodiscard]] std::shared_ptr<libcamera::Camera>
findLibcamera(const libcamera::CameraManager& manager, const CameraWish& wish);

}  // namespace mfar
