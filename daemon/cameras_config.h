#pragma once

#include "base/image_view.h"

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mfar {

class TomlReader;

/// Who speaks with a camera.
enum class CameraDriver {
    Libcamera,
    V4l2,
};

/// One sensor, section [cameras.video] or [cameras.still].
struct CameraConfig {
    CameraDriver driver = CameraDriver::Libcamera;
    /// libcamera: id, model or location; V4L2: device or card name; empty: any but the other one.
    std::string camera{};
    Size size{};
    double rateHz = 0;            ///< 0: on trigger only
    std::string format = "auto";  ///< or a name of the driver's
    bool allowCrop = false;       ///< libcamera: a part of the field of view will do
    /// Name and value, as the camera knows them.
    std::vector<std::pair<std::string, std::string>> controls{};
    bool operator==(const CameraConfig&) const = default;
};

/// The line that triggers the still sensor, section [cameras.trigger].
struct TriggerLineConfig {
    std::string chip;  ///< label, name or path; empty: found by the line's name
    std::string line;  ///< number or name; empty: the still sensor is free-running
    bool activeLow = false;
    double pulseMs = 1;
    bool pulseIsExposure = false;  ///< the sensor exposes as long as the pulse lasts
    std::string loopbackChip;      ///< empty: `chip`
    std::string loopback;          ///< input wired to the line; empty: none
    double delayMs = 0;            ///< from the edge to the start of exposure, a first guess
    double jitterMs = 1;           ///< what stills' times may be off by
    double arrivalMs = 500;        ///< a still that has not come by then is lost
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

/// Reads the section; faults go to `file`.
void readCameras(TomlReader& file, CamerasConfig& cameras);

}  // namespace mfar
