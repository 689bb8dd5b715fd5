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

/// The motion after unit time of a body that turns and moves at a constant rate in its own frame.
[[nodiscard]] RigidTransform exponential(const Vector6& twist);

/// The inverse of exponential() for rotations below pi.
[[nodiscard]] Vector6 logarithm(const RigidTransform& motion);

/// T exp(x) = exp(adjoint(T) x) T.
[[nodiscard]] Matrix6 adjoint(const RigidTransform& T);

/// T exp(x) T^-1 to first order: the covariance of a pose given in b's frame, given in a's.
[[nodiscard]] inline Matrix6 moved(const Matrix6& covariance, const RigidTransform& T_a_b) {
    const Matrix6 a = adjoint(T_a_b);
    return a * covariance * a.transpose();
}

[[nodiscard]] bool isFinite(const RigidTransform& T);

/// The same motion, its rotation a unit quaternion; nothing when it is not finite or its rotation
/// is farther from one than rounding and careless files bring it (a tenth).
[[nodiscard]] std::optional<RigidTransform> soundMotion(const RigidTransform& T);

}  // namespace mfar
