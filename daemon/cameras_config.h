#pragma once

#include "base/image_view.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

class TomlReader;

enum class CameraDriver {
    Libcamera,
    V4l2,
};

struct CameraConfig {
    CameraDriver driver = CameraDriver::Libcamera;
    /// With libcamera: id, model or location of the camera. With V4L2: path or bus of the device,
    /// or name of the card. Empty: any camera, except the one configured for the other sensor.
    std::string camera{};
    Size size{};
    double rateHz = 0;            ///< 0: the camera is triggered or free-running
    std::string format = "auto";  ///< "auto" or the driver's name of a format
    bool allowCrop = false;  ///< libcamera only: modes with a cropped field of view are allowed
    std::vector<std::pair<std::string, std::string>> controls{};
    bool operator==(const CameraConfig&) const = default;
};

/// Section [cameras.trigger] of the configuration: the GPIO line that triggers the still sensor.
struct TriggerLineConfig {
    std::string chip;  ///< label, name or path of the GPIO chip; empty: the chip that has the line
    std::string line;  ///< number or name of the line; empty: the still sensor is free-running
    bool activeLow = false;
    double pulseMs = 1;
    bool pulseIsExposure = false;  ///< true: the sensor exposes as long as the pulse lasts
    std::string loopbackChip;
    std::string loopback;  ///< input wired to the trigger line, to measure its timing; empty: none
    double delayMs = 0;    ///< first estimate of the time from trigger pulse to exposure
    double jitterMs = 1;   ///< largest error of the still camera's timestamps
    /// A still that arrives more than this time after its exposure counts as lost.
    double arrivalMs = 500;
    bool operator==(const TriggerLineConfig&) const = default;
};

/// Section [cameras] of the configuration: the cameras that `source = "cameras"` opens.
struct CamerasConfig {
    std::filesystem::path calibration;  ///< empty: nominal lenses, see nominalRig()
    CameraConfig video{.size = {640, 480}, .rateHz = 30};
    CameraConfig still{.size = {2304, 1728}};
    TriggerLineConfig trigger;
    bool operator==(const CamerasConfig&) const = default;
};

/// `stillTimeoutS`: the key trigger.timeout_s. Pulses of a trigger line must be shorter.
void readCameras(TomlReader& file, double stillTimeoutS, CamerasConfig& cameras);

}  // namespace mfar
