#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_compat.h"
#include "hal/device/libcamera_controls.h"
#include "hal/device/picture_layout.h"

#include <memory>
#include <optional>

namespace mfar {

struct ConfiguredCamera {
    std::unique_ptr<libcamera::CameraConfiguration> configuration;  ///< with one stream
    PictureLayout layout;
};

/// Configures a camera, which must be acquired, for one stream. Throws std::runtime_error.
[[nodiscard]] ConfiguredCamera configureLibcamera(libcamera::Camera& camera,
                                                  const LibcameraOptions& options);

/// Converts the options to control values of this camera. Throws std::runtime_error.
[[nodiscard]] ControlValues controlsFor(const libcamera::Camera& camera,
                                        const LibcameraOptions& options);

/// Returns the size of the sensor's active area [px], or nothing if the camera does not report it.
[[nodiscard]] std::optional<Size> activePixels(const libcamera::Camera& camera);

/// Returns a message if `crop`, the used part of the sensor, shows only a part of the field of
/// view. Returns nothing if it shows the whole field, if the camera does not report the areas, or
/// if the options allow a crop.
[[nodiscard]] std::optional<std::string> cropFault(const libcamera::Camera& camera,
                                                   const std::optional<libcamera::Rectangle>& crop,
                                                   const LibcameraOptions& options);

}  // namespace mfar
