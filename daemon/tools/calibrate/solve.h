#pragma once

#include "base/calibration/rig_files.h"
#include "daemon/tools/calibrate/camera_fit.h"
#include "daemon/tools/calibrate/rig_bundle.h"

#include <string>
#include <vector>

namespace mfar::calibration {

struct SensorViews {
    Size picture;
    std::vector<TargetView> views;
};

struct SolveOptions {
    double maxOffset = 0.25;  ///< largest absolute clock offset of the still camera [s]
    bool k3 = false;          ///< true: the third radial coefficient is estimated
    /// Largest numbers of video views and stills for the lens calibration.
    int videoViews = 40;
    int stillViews = 40;
};

struct ViewResult {
    Timestamp time;
    std::vector<Corner> corners;
    std::vector<Eigen::Vector2d> residuals;  ///< measured minus expected positions [px]
    bool used = false;                       ///< false: not used, because its error is large
};

struct SensorResult {
    CameraModel camera;
    /// Standard deviations of fx fy cx cy k1 k2 p1 p2 k3; 0: the parameter was not estimated.
    Eigen::Matrix<double, 9, 1> deviations;
    std::vector<ViewResult> views;
    double rms = 0;  ///< RMS residual of the corners in the used views [px]
};

struct Calibration {
    RigCalibration rig;
    SensorResult video, still;
    /// Standard deviations of T_still_video: rotation [rad] and translation [m].
    Eigen::Matrix<double, 6, 1> extrinsicDeviations;
    double offsetDeviation = 0;  ///< standard deviation of the clock offset [s]
    bool offsetKnown = true;     ///< false: too little motion or maxOffset is 0, so the offset is 0
    int pairs = 0;               ///< number of stills whose poses were interpolated from the video
};

/// Calibrates both cameras and the transform between them. Throws Unsuitable if the views do not
/// suffice.
[[nodiscard]] Calibration calibrate(const Target& target, const SensorViews& video,
                                    const SensorViews& still, const SolveOptions& options);

}  // namespace mfar::calibration
