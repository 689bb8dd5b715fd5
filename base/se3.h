#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <optional>

namespace mfar {

/// A small motion, or its rate: elements 0 to 2 are the rotation [rad], elements 3 to 5 the
/// translation.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Returns the matrix of the cross product: skew(a) b = a x b.
[[nodiscard]] Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Returns the exponential map of SE(3): the motion of a body in unit time. `twist` is the body's
/// constant rate of rotation and translation in its own frame.
[[nodiscard]] RigidTransform exponential(const Vector6& twist);

/// Returns the inverse of exponential(). The angle of rotation must be less than pi.
[[nodiscard]] Vector6 logarithm(const RigidTransform& motion);

/// Returns the adjoint of T, which satisfies T exp(x) = exp(adjoint(T) x) T.
[[nodiscard]] Matrix6 adjoint(const RigidTransform& T);

/// Transforms the covariance of a pose from frame b to frame a, to first order.
[[nodiscard]] inline Matrix6 moved(const Matrix6& covariance, const RigidTransform& T_a_b) {
    const Matrix6 a = adjoint(T_a_b);
    return a * covariance * a.transpose();
}

[[nodiscard]] bool isFinite(const RigidTransform& T);

/// Returns T with its rotation normalised to a unit quaternion. Returns nothing if T is not finite
/// or the quaternion's norm differs from 1 by more than 0.1. Smaller errors are accepted, because
/// files round their numbers.
[[nodiscard]] std::optional<RigidTransform> soundMotion(const RigidTransform& T);

}  // namespace mfar
