#pragma once

#include "base/geometry.h"
#include "daemon/tools/calibrate/target.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar::calibration {

/// The views cannot calibrate the board. One sentence that says what is missing.
class Unsuitable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Pose of the target in one view with a given camera, T_camera_target; nothing for less than six
/// corners or when they do not fit a plane.
[[nodiscard]] std::optional<RigidTransform> targetPose(const Target& target, const TargetView& view,
                                                       const CameraModel& camera);

/// measured - expected pixel per corner of a view.
[[nodiscard]] std::vector<Eigen::Vector2d> residualsOf(const Target& target, const TargetView& view,
                                                       const CameraModel& camera,
                                                       const RigidTransform& T_camera_target);
/// Root mean square length.
[[nodiscard]] double rms(const std::vector<Eigen::Vector2d>& residuals);

/// A guess of a camera of which nothing but the picture's size is known: 50 degrees wide.
[[nodiscard]] CameraModel guessedCamera(Size picture);

/// Throws Unsuitable unless the views are enough in number, cover the picture and show the target
/// from different directions and at different depths. `sensor` names it in the message.
void checkViews(const Target& target, const std::vector<TargetView>& views, Size picture,
                const std::string& sensor, int leastViews);

/// One camera on its own.
struct CameraFit {
    CameraModel camera;
    std::vector<std::optional<RigidTransform>> poses;  ///< T_camera_target per view; nothing: bad
    std::vector<int> chosen;                           ///< views it was made from
    double sigma = 0;                                  ///< of a corner's coordinate, robust [px]
};

/// Intrinsics and distortion (k3 stays 0) from up to `most` views that differ the most. Views that
/// do not fit are left out, corners that do not fit are removed from `views`. Throws Unsuitable.
[[nodiscard]] CameraFit fitCamera(const Target& target, std::vector<TargetView>& views,
                                  Size picture, const std::string& sensor, int most);

/// Which values are far above the others: more than 4 robust deviations and twice the median.
[[nodiscard]] std::vector<bool> outliers(const std::vector<double>& values);

}  // namespace mfar::calibration
