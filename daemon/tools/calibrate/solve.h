#pragma once

#include "base/calibration/rig_files.h"
#include "daemon/tools/calibrate/camera_fit.h"
#include "daemon/tools/calibrate/rig_bundle.h"

#include <string>
#include <vector>

namespace mfar::calibration {

/// All that one sensor saw of the target.
struct SensorViews {
    Size picture;
    std::vector<TargetView> views;  ///< rising in time
};

struct SolveOptions {
    double maxOffset = 0.25;  ///< largest offset of the still's clock that is sought [s]
    bool k3 = false;          ///< estimate the third radial coefficient
    int videoViews = 40;      ///< that lenses are measured with
    int stillViews = 40;
};

struct ViewResult {
    Timestamp time;
    std::vector<Corner> corners;
    std::vector<Eigen::Vector2d> residuals;  ///< measured - expected [px]
    bool used = false;                       ///< false: left out because it fits badly
};

struct SensorResult {
    CameraModel camera;
    Eigen::Matrix<double, 9, 1> deviations;  ///< of fx fy cx cy k1 k2 p1 p2 k3, 0: not estimated
    std::vector<ViewResult> views;           ///< that were used, and those that were left out
    double rms = 0;                          ///< length of a corner's error [px]
};

struct Calibration {
    RigCalibration rig;
    SensorResult video, still;
    Eigen::Matrix<double, 6, 1> extrinsicDeviations;  ///< rotation [rad], translation [m]
    double offsetDeviation = 0;                       ///< [s]
    bool offsetKnown = true;  ///< false: the camera moved too little to see it, it is taken as 0
    int pairs = 0;            ///< stills that were seen together with the video
};

/// The whole calibration. Throws Unsuitable with one sentence when the views cannot give it.
[[nodiscard]] Calibration calibrate(const Target& target, const SensorViews& video,
                                    const SensorViews& still, const SolveOptions& options);

}  // namespace mfar::calibration
