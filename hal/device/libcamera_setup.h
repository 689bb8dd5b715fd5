#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_compat.h"
#include "hal/device/libcamera_controls.h"
#include "hal/device/picture_layout.h"

#include <memory>
#include <optional>

namespace mfar {

struct ConfiguredCamera {
    std::unique_ptr<libcamera::CameraConfiguration> configuration;  ///< has one stream
    PictureLayout layout;
};

/// Configures an acquired camera for one stream. Throws std::runtime_error.
[[nodiscard]] ConfiguredCamera configureLibcamera(libcamera::Camera& camera,
                                                  const LibcameraOptions& options);

/// The options as control values for this camera. Throws std::runtime_error.
[[nodiscard]] ControlValues controlsFor(const libcamera::Camera& camera,
                                        const LibcameraOptions& options);

/// The sensor's active pixels; empty when the camera does not report them.
[[nodiscard]] std::optional<Size> activePixels(const libcamera::Camera& camera);

/// Message that `crop` shows only a part of the sensor's field in pictures of size `output`; empty
/// for the whole field, if the camera does not report it, or if the options allow it.
[[nodiscard]] std::optional<std::string> cropFault(const libcamera::Camera& camera,
                                                   const std::optional<libcamera::Rectangle>& crop,
                                                   const LibcameraOptions& options);

}  // namespace mfar
