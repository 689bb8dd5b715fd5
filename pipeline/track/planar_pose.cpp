#include "pipeline/track/tag_pose.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Returns the homography from the square's corners to their rays. It is scaled so that its last
/// entry is 1. Empty if the corners do not determine it.
std::optional<Matrix3d> homography(const std::array<Vector2d, 4>& rays) {
    Eigen::Matrix<double, 8, 8> A = Eigen::Matrix<double, 8, 8>::Zero();
    Eigen::Matrix<double, 8, 1> b;
    for (int k = 0; k < 4; ++k) {
        const double x = kTagCorners[k].x(), y = kTagCorners[k].y();
        const double u = rays[k].x(), v = rays[k].y();
        A.row(2 * k) << x, y, 1, 0, 0, 0, -u * x, -u * y;
        A.row(2 * k + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
        b.segment<2>(2 * k) << u, v;
    }
    const Eigen::FullPivLU<Eigen::Matrix<double, 8, 8>> lu(A);
    if (!lu.isInvertible()) return std::nullopt;
    const Eigen::Matrix<double, 8, 1> h = lu.solve(b);
    if (!h.allFinite()) return std::nullopt;
    Matrix3d H;
    H << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1;
    return H;
}

/// Returns a rotation that turns the z axis to the direction (p, 1).
Matrix3d towards(const Vector2d& p) {
    // w is the cosine of half the angle between `direction` and the z axis. The whole angle is
    // below 90 degrees, so w is above sqrt(0.5), and dividing by w is safe.
    const Vector3d direction = p.homogeneous().normalized();
    const double w = std::sqrt((1 + direction.z()) / 2);
    return Eigen::Quaterniond(w, -direction.y() / (2 * w), direction.x() / (2 * w), 0)
        .toRotationMatrix();
}

double largestSingularValue(const Matrix2d& A) {
    return (std::hypot(A(0, 0) + A(1, 1), A(0, 1) - A(1, 0)) +
            std::hypot(A(0, 0) - A(1, 1), A(0, 1) + A(1, 0))) /
           2;
}

/// Returns the translation t that fits the four corners X and their rays (u, v) best. The equations
/// u (r3 . X + tz) = r1 . X + tx and v (r3 . X + tz) = r2 . X + ty are solved by least squares.
Vector3d translationOf(const Matrix3d& R, const std::array<Vector2d, 4>& rays) {
    Eigen::Matrix<double, 8, 3> A;
    Eigen::Matrix<double, 8, 1> b;
    for (int k = 0; k < 4; ++k) {
        const Vector3d X = R.leftCols<2>() * kTagCorners[k];
        A.row(2 * k) << 1, 0, -rays[k].x();
        A.row(2 * k + 1) << 0, 1, -rays[k].y();
        b.segment<2>(2 * k) << rays[k].x() * X.z() - X.x(), rays[k].y() * X.z() - X.y();
    }
    return (A.transpose() * A).ldlt().solve(A.transpose() * b);
}

double errorOf(const RigidTransform& T, const std::array<Vector2d, 4>& rays) {
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        const Vector3d p = T * Vector3d(kTagCorners[k].x(), kTagCorners[k].y(), 0);
        sum += (p.head<2>() / p.z() - rays[k]).squaredNorm();
    }
    return sum;
}

}  // namespace

std::optional<std::array<RigidTransform, 2>> planarPoses(const std::array<Vector2d, 4>& rays) {
    const auto H = homography(rays);
    if (!H) return std::nullopt;
    // Both poses follow from two things: the image p of the square's centre, and the homography's
    // Jacobian J at the centre.
    const Vector2d p = H->topRightCorner<2, 1>();
    const Matrix2d J = H->topLeftCorner<2, 2>() - p * H->bottomLeftCorner<1, 2>();
    const Matrix3d V = towards(p);
    Matrix2d B = V.topLeftCorner<2, 2>() - p * V.bottomLeftCorner<1, 2>();
    if (!(std::abs(B.determinant()) > 1e-12)) return std::nullopt;
    const Matrix2d A = B.inverse() * J;
    const double gamma = largestSingularValue(A);
    if (!(gamma > 1e-12)) return std::nullopt;
    const Matrix2d r = A / gamma;
    const double b0 = std::sqrt(std::max(0., 1 - r.col(0).squaredNorm()));
    double b1 = std::sqrt(std::max(0., 1 - r.col(1).squaredNorm()));
    if (-r.col(0).dot(r.col(1)) < 0) b1 = -b1;
    std::array<RigidTransform, 2> out;
    for (int i = 0; i < 2; ++i) {
        const double sign = i == 0 ? 1 : -1;
        Matrix3d R;
        R.col(0) << r.col(0), sign * b0;
        R.col(1) << r.col(1), sign * b1;
        R.col(2) = R.col(0).cross(R.col(1));
        const Eigen::Quaterniond q(V * R);
        out[i].rotation = q.normalized();
        out[i].translation = translationOf(out[i].rotation.toRotationMatrix(), rays);
        if (!isFinite(out[i]) || !(out[i].translation.z() > 0)) return std::nullopt;
    }
    if (errorOf(out[1], rays) < errorOf(out[0], rays)) std::swap(out[0], out[1]);
    return out;
}

}  // namespace mfar
