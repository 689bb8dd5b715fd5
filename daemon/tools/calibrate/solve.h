#pragma once

#include "base/calibration/rig_files.h"
#include "daemon/tools/calibrate/camera_fit.h"
#include "daemon/tools/calibrate/rig_bundle.h"

#include <string>
#include <vector>

namespace mfar::calibration {

/// All views of the target by one sensor.
struct SensorViews {
    Size picture;
    std::vector<TargetView> views;  ///< sorted by time
};

struct SolveOptions {
    double maxOffset = 0.25;  ///< search range of the still's clock offset, +- [s]
    bool k3 = false;          ///< estimate the third radial coefficient
    int videoViews = 40;      ///< upper limit of views for the lens calibration
    int stillViews = 40;
};

struct ViewResult {
    Timestamp time;
    std::vector<Corner> corners;
    std::vector<Eigen::Vector2d> residuals;  ///< measured - expected [px]
    bool used = false;                       ///< false: left out because of a large error
};

struct SensorResult {
    CameraModel camera;
    Eigen::Matrix<double, 9, 1> deviations;  ///< of fx fy cx cy k1 k2 p1 p2 k3, 0: not estimated
    std::vector<ViewResult> views;           ///< used and unused views
    double rms = 0;                          ///< of the length of a corner's error [px]
};

struct Calibration {
    RigCalibration rig;
    SensorResult video, still;
    Eigen::Matrix<double, 6, 1> extrinsicDeviations;  ///< rotation [rad], translation [m]
    double offsetDeviation = 0;                       ///< [s]
    bool offsetKnown = true;  ///< false: too little motion to estimate the offset, it is taken as 0
    int pairs = 0;            ///< number of stills taken while the video saw the target
};

/// The complete calibration. Throws Unsuitable with one sentence when the views are not sufficient.
[[nodiscard]] Calibration calibrate(const Target& target, const SensorViews& video,
                                    const SensorViews& still, const SolveOptions& options);

}  // namespace mfar::calibration
