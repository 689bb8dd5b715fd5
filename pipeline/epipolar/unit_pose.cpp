#include "pipeline/epipolar/unit_pose.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace mfar {
namespace {

// Standard deviations that are added to every relative pose: of the rotation [rad], and of the
// translation [fraction of its length]. Even a pose that is said to be exact has errors from the
// calibration, the exposure times and rounding.
constexpr double kLeastTurn = 2.6e-3;
constexpr double kLeastShift = 0.01;
constexpr double kRounding = 1e-12;
// Largest squared Mahalanobis distance (6 degrees of freedom) between two poses of a resting
// camera.
constexpr double kSamePose = 50;

Matrix6 relativeCovariance(const Pose& other, const Pose& frame, double distance) {
    const RigidTransform T_frame_other = frame.T_world_video.inverse() * other.T_world_video;
    Matrix6 out = frame.covariance + moved(other.covariance, T_frame_other);
    out.diagonal().head<3>().array() += kLeastTurn * kLeastTurn;
    out.diagonal().tail<3>().array() += std::pow(kLeastShift * distance, 2);
    return out;
}

}  // namespace

UnitPose unitPose(const RigidTransform& T_camera_video, const Pose& other, const Pose& frame) {
    UnitPose out;
    out.T_other_frame = T_camera_video * other.T_world_video.inverse() * frame.T_world_video;
    const double distance = out.T_other_frame.translation.norm();
    out.covariance = relativeCovariance(other, frame, distance);
    const double least =
        kRounding * (T_camera_video.translation.norm() + other.T_world_video.translation.norm() +
                     frame.T_world_video.translation.norm());
    out.unit = distance > least ? distance : 1;
    out.T_other_frame.translation *= distance > least ? 1 / out.unit : 0;
    out.covariance.topRightCorner<3, 3>() /= out.unit;
    out.covariance.bottomLeftCorner<3, 3>() /= out.unit;
    out.covariance.bottomRightCorner<3, 3>() /= out.unit * out.unit;
    const Eigen::Vector3d along =
        out.T_other_frame.rotation.conjugate() * out.T_other_frame.translation;
    out.lengthError = std::sqrt(along.dot(out.covariance.bottomRightCorner<3, 3>() * along));
    return out;
}

UnitPose restingPose(const RigidTransform& T_camera_video, const Pose& other, const Pose& frame) {
    UnitPose moving = unitPose(T_camera_video, other, frame);
    const RigidTransform T_other_frame = other.T_world_video.inverse() * frame.T_world_video;
    const Vector6 apart = logarithm(T_other_frame);
    // Without a baseline between the cameras, exact poses have a singular covariance.
    const Eigen::LLT<Matrix6> covariance(
        relativeCovariance(other, frame, T_camera_video.translation.norm()));
    if (covariance.info() != Eigen::Success || !(apart.dot(covariance.solve(apart)) < kSamePose))
        return moving;
    const Pose same{frame.time, {}};
    return unitPose(T_camera_video, same, same);
}

}  // namespace mfar
