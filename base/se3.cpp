#include "base/se3.h"

#include <cmath>

namespace mfar {
namespace {

/// The coefficients a and b of the matrix V = I + a [w] + b [w]^2. Here, w is the rotation of a
/// twist [rad], [w] is skew(w), and t is the norm of w. V times the twist's translation is the
/// translation of exponential(twist). For t below 1e-4, a and b are computed by series, whose error
/// is less than a double's rounding.
struct VCoefficients {
    double a, b;
};

VCoefficients vCoefficients(double t) {
    if (t < 1e-4) return {0.5 - t * t / 24, 1. / 6 - t * t / 120};
    return {(1 - std::cos(t)) / (t * t), (t - std::sin(t)) / (t * t * t)};
}

}  // namespace

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
    Eigen::Matrix3d m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
}

RigidTransform exponential(const Vector6& twist) {
    const Eigen::Vector3d w = twist.head<3>(), v = twist.tail<3>();
    const double t = w.norm();
    const double half = t < 1e-4 ? 0.5 - t * t / 48 : std::sin(t / 2) / t;
    const Eigen::Vector3d axis = half * w;
    const Eigen::Quaterniond rotation(std::cos(t / 2), axis.x(), axis.y(), axis.z());
    const auto [a, b] = vCoefficients(t);
    const Eigen::Vector3d wv = w.cross(v);
    return {rotation.normalized(), v + a * wv + b * w.cross(wv)};
}

Vector6 logarithm(const RigidTransform& motion) {
    Eigen::Quaterniond q = motion.rotation.normalized();
    if (q.w() < 0) q.coeffs() = -q.coeffs();
    const double sine = q.vec().norm();
    const double t = 2 * std::atan2(sine, q.w());
    const Eigen::Vector3d w = q.vec() * (sine < 1e-8 ? 2 : t / sine);
    const auto [a, b] = vCoefficients(t);
    const Eigen::Matrix3d W = skew(w);
    const Eigen::Matrix3d V = Eigen::Matrix3d::Identity() + a * W + b * W * W;
    Vector6 out;
    out << w, V.inverse() * motion.translation;
    return out;
}

Matrix6 adjoint(const RigidTransform& T) {
    const Eigen::Matrix3d R = T.rotation.toRotationMatrix();
    Matrix6 out = Matrix6::Zero();
    out.topLeftCorner<3, 3>() = R;
    out.bottomRightCorner<3, 3>() = R;
    out.bottomLeftCorner<3, 3>() = skew(T.translation) * R;
    return out;
}

bool isFinite(const RigidTransform& T) {
    return T.rotation.coeffs().allFinite() && T.translation.allFinite();
}

std::optional<RigidTransform> soundMotion(const RigidTransform& T) {
    const double norm = T.rotation.norm();
    if (!isFinite(T) || !(norm > 0.9 && norm < 1.1)) return std::nullopt;
    return RigidTransform{T.rotation.normalized(), T.translation};
}

}  // namespace mfar
