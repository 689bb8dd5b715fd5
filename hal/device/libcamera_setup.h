#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_compat.h"
#include "hal/device/libcamera_controls.h"
#include "hal/device/picture_layout.h"

#include <memory>
#include <optional>

namespace mfar {

struct ConfiguredCamera {
    std::unique_ptr<libcamera::CameraConfiguration> configuration;
    PictureLayout layout;
};

/// Configures a camera for one stream. The camera must have been acquired. Throws
/// std::runtime_error.
[[nodiscard]] ConfiguredCamera configureLibcamera(libcamera::Camera& camera,
                                                  const LibcameraOptions& options);

[[nodiscard]] ControlValues controlsFor(const libcamera::Camera& camera,
                                        const LibcameraOptions& options);

[[nodiscard]] std::optional<Size> activePixels(const libcamera::Camera& camera);

/// Returns a message if pictures show only a part of the field of view. `crop` is the used part of
/// the sensor. Returns nothing if the camera does not report its areas or if the options allow a
/// crop.
[[nodiscard]] std::optional<std::string> cropFault(const libcamera::Camera& camera,
                                                   const std::optional<libcamera::Rectangle>& crop,
                                                   const LibcameraOptions& options);

}  // namespace mfar
