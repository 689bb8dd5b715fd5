#pragma once

#include "base/geometry.h"
#include "daemon/tools/calibrate/target.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar::calibration {

/// Reports that the views do not suffice for a calibration. The message is one sentence about what
/// is missing.
class Unsuitable : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Returns the pose T_camera_target of the target in one view. Returns nothing if the view has
/// fewer than six corners, if no pose in front of the camera is found, or if the RMS error is 3 %
/// of the picture's width or more.
[[nodiscard]] std::optional<RigidTransform> targetPose(const Target& target, const TargetView& view,
                                                       const CameraModel& camera);

/// Returns the residual of each corner of a view: measured minus expected position [px].
[[nodiscard]] std::vector<Eigen::Vector2d> residualsOf(const Target& target, const TargetView& view,
                                                       const CameraModel& camera,
                                                       const RigidTransform& T_camera_target);
[[nodiscard]] double rms(const std::vector<Eigen::Vector2d>& residuals);

/// Returns a first estimate of the camera, without distortion. A few focal lengths are tried; the
/// estimate has the one that fits the views best.
[[nodiscard]] CameraModel guessedCamera(const Target& target, const std::vector<TargetView>& views,
                                        Size picture);

/// Throws Unsuitable unless at least `leastViews` views cover the picture and show the target from
/// different directions and at different depths. `guess`: see guessedCamera(). `sensor` names the
/// sensor in the message.
void checkViews(const Target& target, const std::vector<TargetView>& views,
                const CameraModel& guess, const std::string& sensor, int leastViews);

struct CameraFit {
    CameraModel camera;
    /// T_camera_target of each view. Not set: the view does not fit the other views.
    std::vector<std::optional<RigidTransform>> poses;
    std::vector<int> chosen;  ///< indices of the views to which the camera was fitted
    double sigma = 0;  ///< robust standard deviation of the corners' residuals in x and y [px]
};

/// Fits intrinsics and distortion (k3 stays 0) to at most `most` views. The views are chosen so
/// that they differ as much as possible. Views that do not fit are ignored. Corners that do not fit
/// are removed from `views`. `guess`: see guessedCamera(). Throws Unsuitable.
[[nodiscard]] CameraFit fitCamera(const Target& target, std::vector<TargetView>& views,
                                  const CameraModel& guess, const std::string& sensor, int most);

/// Returns true for each value that is an outlier: more than twice the median, and more than 4
/// robust standard deviations above the median.
[[nodiscard]] std::vector<bool> outliers(const std::vector<double>& values);

}  // namespace mfar::calibration
