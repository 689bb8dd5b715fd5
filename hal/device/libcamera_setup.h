#pragma once

#include "hal/device/camera_libcamera.h"
#include "hal/device/libcamera_compat.h"
#include "hal/device/libcamera_controls.h"
#include "hal/device/picture_layout.h"

#include <memory>
#include <optional>

namespace mfar {

struct ConfiguredCamera {
    std::unique_ptr<libcamera::CameraConfiguration> configuration;  ///< one stream
    PictureLayout layout;
};

/// Configures an acquired camera for one stream. Throws std::runtime_error.
[[nodiscard]] ConfiguredCamera configureLibcamera(libcamera::Camera& camera,
                                                  const LibcameraOptions& options);

/// The options' controls as values for this camera. Throws std::runtime_error.
[[nodiscard]] ControlValues controlsFor(const libcamera::Camera& camera,
                                        const LibcameraOptions& options);

/// The pixels of the sensor that can see; nothing when the camera does not tell.
[[nodiscard]] std::optional<Size> activePixels(const libcamera::Camera& camera);

/// What is wrong with showing `crop` of the sensor in pictures of `output`, for messages; nothing
/// when it is the whole field, the camera does not tell, or the options allow it.
[[nodiscard]] std::optional<std::string> cropFault(const libcamera::Camera& camera,
                                                   const std::optional<libcamera::Rectangle>& crop,
                                                   const LibcameraOptions& options);

}  // namespace mfar
