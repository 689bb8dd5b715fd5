#pragma once

#include "base/image_view.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

class TomlReader;

/// Which library drives a camera.
enum class CameraDriver {
    Libcamera,
    V4l2,
};

/// One sensor, section [cameras.video] or [cameras.still].
struct CameraConfig {
    CameraDriver driver = CameraDriver::Libcamera;
    /// libcamera: id, model or location; V4L2: device or card name; empty: any camera but the other
    /// one
    std::string camera{};
    Size size{};
    double rateHz = 0;            ///< 0: triggered only
    std::string format = "auto";  ///< or the driver's name of a format
    bool allowCrop = false;       ///< libcamera: cropping the field of view is allowed
    /// Control names and values, as the camera defines them.
    std::vector<std::pair<std::string, std::string>> controls{};
    bool operator==(const CameraConfig&) const = default;
};

/// The line that triggers the still sensor, section [cameras.trigger].
struct TriggerLineConfig {
    std::string chip;  ///< label, name or path; empty: the chip that has the named line
    std::string line;  ///< number or name; empty: the still sensor is free-running
    bool activeLow = false;
    double pulseMs = 1;
    bool pulseIsExposure = false;  ///< the pulse length sets the exposure time
    std::string loopbackChip;      ///< empty: `chip`
    std::string loopback;          ///< input wired to the trigger line; empty: no loopback
    double delayMs = 0;            ///< from the edge to the start of exposure, initial estimate
    double jitterMs = 1;           ///< error bound of stills' times
    double arrivalMs = 500;        ///< a still that has not come after this time is lost
    bool operator==(const TriggerLineConfig&) const = default;
};

/// Section [cameras]: what `source = "cameras"` opens.
struct CamerasConfig {
    std::filesystem::path calibration;  ///< empty: nominal lenses, see nominalRig()
    CameraConfig video{.size = {640, 480}, .rateHz = 30};
    CameraConfig still{.size = {2304, 1728}};
    TriggerLineConfig trigger;
    bool operator==(const CamerasConfig&) const = default;
};

/// Reads the section; faults are added to `file`.
void readCameras(TomlReader& file, CamerasConfig& cameras);

}  // namespace mfar
