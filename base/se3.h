#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <optional>

namespace mfar {

/// Rotation [rad] first, translation second, as in Pose::covariance.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The matrix of the cross product: skew(a) b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// The motion after unit time of a body that rotates and translates at a constant rate in its own
/// frame.
[[nodiscard]] RigidTransform exponential(const Vector6& twist);

/// The inverse of exponential() for rotations below pi.
[[nodiscard]] Vector6 logarithm(const RigidTransform& motion);

/// T exp(x) = exp(adjoint(T) x) T.
[[nodiscard]] Matrix6 adjoint(const RigidTransform& T);

/// T exp(x) T^-1 to first order: transforms the covariance of a pose from frame b to frame a.
[[nodiscard]] inline Matrix6 moved(const Matrix6& covariance, const RigidTransform& T_a_b) {
    const Matrix6 a = adjoint(T_a_b);
    return a * covariance * a.transpose();
}

[[nodiscard]] bool isFinite(const RigidTransform& T);

/// The motion with its rotation as a unit quaternion; empty when it is not finite or the
/// quaternion's norm differs from one by more than a tenth, the limit for rounding and careless
/// files.
[[nodiscard]] std::optional<RigidTransform> soundMotion(const RigidTransform& T);

}  // namespace mfar
