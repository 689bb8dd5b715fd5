#include "base/geometry.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

// The lens model is inverted only where the determinant of its Jacobian is above kFold. The
// determinant is zero where the model folds over: there, several rays begin to map to one pixel.
constexpr double kFold = 0.05;
constexpr double kSquaredError = 1e-24;

struct Distorted {
    Eigen::Vector2d point;
    Eigen::Matrix2d jacobian;
};

Distorted distort(const Eigen::Vector2d& ray, const std::array<double, 5>& d) {
    const auto [k1, k2, p1, p2, k3] = d;
    const double x = ray.x(), y = ray.y();
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double slope = k1 + r2 * (2 * k2 + 3 * r2 * k3);
    Distorted out;
    out.point = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                 y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
    out.jacobian << radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x,
        2 * x * y * slope + 2 * p1 * x + 2 * p2 * y, 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y,
        radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x;
    return out;
}

Eigen::Vector2d pinholeRay(const CameraModel& c, const Eigen::Vector2d& pixel) {
    return {(pixel.x() - c.cx) / c.fx, (pixel.y() - c.cy) / c.fy};
}

struct Undistorted {
    Eigen::Vector2d ray;
    bool isExact;
};

Undistorted undistorted(const Eigen::Vector2d& target, const Eigen::Vector2d& start,
                        const std::array<double, 5>& distortion, int most) {
    if (distortion == std::array<double, 5>{}) return {target, true};
    Eigen::Vector2d ray = start;
    for (int i = 0; i < most; ++i) {
        const Distorted d = distort(ray, distortion);
        const Eigen::Vector2d error = target - d.point;
        const double det = d.jacobian.determinant();
        // The iteration must not cross the fold of the lens model, where `det` is zero.
        if (!(det > kFold)) break;
        if (!(error.squaredNorm() > kSquaredError)) return {ray, true};
        Eigen::Vector2d step = d.jacobian.inverse() * error;
        const double limit = 0.5 * std::max(0.2, ray.norm());
        if (step.norm() > limit) step *= limit / step.norm();
        ray += step;
    }
    return {ray, false};
}

}  // namespace

Eigen::Vector2d CameraModel::project(const Eigen::Vector2d& ray) const {
    const Eigen::Vector2d p = distort(ray, distortion).point;
    return {fx * p.x() + cx, fy * p.y() + cy};
}

Eigen::Matrix2d CameraModel::projectJacobian(const Eigen::Vector2d& ray) const {
    return Eigen::Vector2d(fx, fy).asDiagonal() * distort(ray, distortion).jacobian;
}

Eigen::Vector2d CameraModel::unproject(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d target = pinholeRay(*this, pixel);
    return undistorted(target, target, distortion, 20).ray;
}

Eigen::Vector2d CameraModel::unproject(const Eigen::Vector2d& pixel,
                                       const Eigen::Vector2d& close) const {
    const Undistorted found = undistorted(pinholeRay(*this, pixel), close, distortion, 3);
    return found.isExact ? found.ray : unproject(pixel);
}

CameraModel CameraModel::scaledTo(Size to) const {
    const double sx = static_cast<double>(to.width) / size.width;
    const double sy = static_cast<double>(to.height) / size.height;
    CameraModel out = *this;
    out.size = to;
    out.fx *= sx;
    out.fy *= sy;
    out.cx = (cx + 0.5) * sx - 0.5;
    out.cy = (cy + 0.5) * sy - 0.5;
    return out;
}

}  // namespace mfar
