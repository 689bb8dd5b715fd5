#pragma once

#include "base/geometry.h"
#include "daemon/tools/calibrate/target.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar::calibration {

/// The views are not sufficient to calibrate the board. The message is one sentence about what is
/// missing.
class Unsuitable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Pose of the target in one view with a given camera, T_camera_target; nothing for fewer than six
/// corners or when they do not fit a plane.
[[nodiscard]] std::optional<RigidTransform> targetPose(const Target& target, const TargetView& view,
                                                       const CameraModel& camera);

/// measured - expected pixel per corner of a view.
[[nodiscard]] std::vector<Eigen::Vector2d> residualsOf(const Target& target, const TargetView& view,
                                                       const CameraModel& camera,
                                                       const RigidTransform& T_camera_target);
/// Root mean square length.
[[nodiscard]] double rms(const std::vector<Eigen::Vector2d>& residuals);

/// Initial guess of a camera from its picture size alone: a field of view of 50 degrees.
[[nodiscard]] CameraModel guessedCamera(Size picture);

/// Throws Unsuitable unless there are enough views that cover the picture and show the target from
/// different directions and at different depths. `sensor` is its name in the message.
void checkViews(const Target& target, const std::vector<TargetView>& views, Size picture,
                const std::string& sensor, int leastViews);

/// Calibration of one camera on its own.
struct CameraFit {
    CameraModel camera;
    std::vector<std::optional<RigidTransform>> poses;  ///< T_camera_target of views; nothing: bad
    std::vector<int> chosen;                           ///< views used for the fit
    double sigma = 0;  ///< robust standard deviation of a corner's coordinate [px]
};

/// Fits intrinsics and distortion (k3 stays 0) to up to `most` views that differ the most. Views
/// that do not fit are ignored, corners that do not fit are removed from `views`. Throws
/// Unsuitable.
[[nodiscard]] CameraFit fitCamera(const Target& target, std::vector<TargetView>& views,
                                  Size picture, const std::string& sensor, int most);

/// Marks values far above the others: above the median by 4 robust deviations, and twice the
/// median.
[[nodiscard]] std::vector<bool> outliers(const std::vector<double>& values);

}  // namespace mfar::calibration
