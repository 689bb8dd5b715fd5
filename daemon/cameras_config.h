#pragma once

#include "base/image_view.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

class TomlReader;

/// The library that drives a camera.
enum class CameraDriver {
    Libcamera,
    V4l2,
};

/// Section [cameras.video] or [cameras.still] of the configuration: one camera.
struct CameraConfig {
    CameraDriver driver = CameraDriver::Libcamera;
    /// With libcamera: the camera's id, model or location. With V4L2: path of the device or name of
    /// the card. Empty: any camera except the one that is configured for the other sensor.
    std::string camera{};
    Size size{};
    double rateHz = 0;            ///< frame rate; 0: the camera is triggered
    std::string format = "auto";  ///< "auto" or the driver's name of a format
    bool allowCrop = false;  ///< libcamera only: modes with a cropped field of view may be used
    /// Names and values of camera controls. The camera's driver defines them.
    std::vector<std::pair<std::string, std::string>> controls{};
    bool operator==(const CameraConfig&) const = default;
};

/// Section [cameras.trigger] of the configuration: the GPIO line that triggers the still sensor.
struct TriggerLineConfig {
    std::string chip;  ///< label, name or path of the GPIO chip; empty: the chip that has the line
    std::string line;  ///< number or name of the line; empty: the still sensor is free-running
    bool activeLow = false;
    double pulseMs = 1;
    bool pulseIsExposure = false;  ///< whether the sensor exposes as long as the pulse lasts
    std::string loopbackChip;      ///< GPIO chip of `loopback`; empty: `chip`
    std::string loopback;    ///< input that is wired to the trigger line, for timing; empty: none
    double delayMs = 0;      ///< first estimate of the time from the trigger pulse to the exposure
    double jitterMs = 1;     ///< largest error of the still camera's timestamps
    double arrivalMs = 500;  ///< a still that comes later than this after its exposure is lost
    bool operator==(const TriggerLineConfig&) const = default;
};

/// Section [cameras] of the configuration: the cameras that `source = "cameras"` opens.
struct CamerasConfig {
    std::filesystem::path calibration;  ///< path; empty: nominal lenses, see nominalRig()
    CameraConfig video{.size = {640, 480}, .rateHz = 30};
    CameraConfig still{.size = {2304, 1728}};
    TriggerLineConfig trigger;
    bool operator==(const CamerasConfig&) const = default;
};

/// Reads section [cameras]. Faults are collected in `file`.
void readCameras(TomlReader& file, CamerasConfig& cameras);

}  // namespace mfar
