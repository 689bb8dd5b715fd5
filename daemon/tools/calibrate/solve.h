#pragma once

#include "base/calibration/rig_files.h"
#include "daemon/tools/calibrate/camera_fit.h"
#include "daemon/tools/calibrate/rig_bundle.h"

#include <string>
#include <vector>

namespace mfar::calibration {

/// All views of the target that one sensor took.
struct SensorViews {
    Size picture;
    std::vector<TargetView> views;  ///< sorted by time
};

struct SolveOptions {
    double maxOffset = 0.25;  ///< largest absolute clock offset of the still camera [s]
    bool k3 = false;          ///< whether the third radial coefficient is estimated
    int videoViews = 40;      ///< largest number of video views for the lens calibration
    int stillViews = 40;      ///< largest number of stills for the lens calibration
};

struct ViewResult {
    Timestamp time;
    std::vector<Corner> corners;
    std::vector<Eigen::Vector2d> residuals;  ///< measured minus expected positions [px]
    bool used = false;  ///< false: the view was not used, because its error is large
};

struct SensorResult {
    CameraModel camera;
    /// Standard deviations of fx fy cx cy k1 k2 p1 p2 k3; 0: the parameter was not estimated.
    Eigen::Matrix<double, 9, 1> deviations;
    std::vector<ViewResult> views;  ///< all views, used or not
    double rms = 0;                 ///< root mean square of the residuals' lengths [px]
};

struct Calibration {
    RigCalibration rig;
    SensorResult video, still;
    /// Standard deviations of T_still_video: rotation [rad] and translation [m].
    Eigen::Matrix<double, 6, 1> extrinsicDeviations;
    double offsetDeviation = 0;  ///< standard deviation of the clock offset [s]
    bool offsetKnown = true;     ///< false: there is too little motion, so the offset is 0
    int pairs = 0;               ///< number of stills taken while the video saw the target
};

/// Calibrates the two cameras and the transform between them. Throws Unsuitable, whose message is
/// one sentence, if the views are not sufficient.
[[nodiscard]] Calibration calibrate(const Target& target, const SensorViews& video,
                                    const SensorViews& still, const SolveOptions& options);

}  // namespace mfar::calibration
