#pragma once

#include "base/geometry.h"

#include <Eigen/Dense>

#include <optional>

namespace mfar::twin {

inline double cross2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

struct TwoViews {
    CameraModel a, b;
    RigidTransform T_b_a;

    [[nodiscard]] Eigen::Vector2d rayA(const Eigen::Vector2d& pixel) const {
        return a.unproject(pixel);
    }
    /// Ray of a pixel of camera b, in the coordinates of camera a, scaled to z = 1.
    [[nodiscard]] Eigen::Vector3d rayB(const Eigen::Vector2d& pixel) const {
        const Eigen::Vector3d ray =
            T_b_a.rotation.conjugate() * b.unproject(pixel).homogeneous().eval();
        return ray / ray.z();
    }
    /// Flow from `pixel` of a to b, for a point at inverse depth `inverseDepth`.
    [[nodiscard]] Eigen::Vector2d flow(const Eigen::Vector2d& pixel, double inverseDepth) const {
        const Eigen::Vector3d point =
            T_b_a.rotation * rayA(pixel).homogeneous().eval() + inverseDepth * T_b_a.translation;
        return b.project(point.hnormalized()) - pixel;
    }
    /// Translation of T_b_a, rotated into the coordinates of camera a.
    [[nodiscard]] Eigen::Vector3d baseline() const {
        return T_b_a.rotation.conjugate() * T_b_a.translation;
    }
    /// Direction of the epipolar line, towards nearer points: the baseline, projected along the ray
    /// onto the plane z = 0 of camera a.
    [[nodiscard]] Eigen::Vector2d line(const Eigen::Vector2d& pixel) const {
        const Eigen::Vector3d t = baseline();
        return t.head<2>() - rayA(pixel) * t.z();
    }
};

struct FlowDepth {
    double inverseDepth, sigma, residual;
};

/// Inverse depth (u . e) / (|e|^2 - b_z (u . e)), its standard deviation, and the
/// component of the flow normal to e [px]. u: flow in normalised coordinates; e: line(); b:
/// baseline().
inline FlowDepth depthFromFlow(const TwoViews& views, const Eigen::Vector2d& pixel,
                               const Eigen::Vector2d& flow, double flowSigma) {
    const double focal = std::sqrt(views.b.fx * views.b.fy);
    const Eigen::Vector2d u = views.rayB(pixel + flow).head<2>() - views.rayA(pixel);
    const Eigen::Vector2d e = views.line(pixel);
    const double d = e.squaredNorm() - views.baseline().z() * u.dot(e);
    return {u.dot(e) / d, flowSigma / focal * std::pow(e.norm(), 3) / (d * d),
            focal * cross2(e.normalized(), u)};
}

struct Midpoint {
    double inverseDepth, rayDistance;
    bool ahead;
};

/// The method of the paper (see docs/paper.md): finds the shortest line between the rays of both
/// pixels. Returns the inverse depth of its midpoint, its length, and whether both of its ends are
/// in front of the cameras.
inline Midpoint midpoint(const TwoViews& views, const Eigen::Vector2d& pixel,
                         const Eigen::Vector2d& flow) {
    const Eigen::Vector3d c = views.T_b_a.inverse().translation;
    Eigen::Matrix<double, 3, 2> rays;
    rays << views.rayA(pixel).homogeneous(), -views.rayB(pixel + flow);
    const Eigen::Vector2d lambda = rays.colPivHouseholderQr().solve(c);
    const Eigen::Vector3d onA = lambda[0] * rays.col(0), onB = c - lambda[1] * rays.col(1);
    return {2 / (onA + onB).z(), (onA - onB).norm(), lambda[0] > 0 && lambda[1] > 0};
}

}  // namespace mfar::twin
