#pragma once

#include "pipeline/composite/virtual_object.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

/// Oracle of the depth of virtual objects. Intersects exact surfaces with the ray of each pixel
/// through the lens.
namespace mfar::twin {

/// Smallest t above `least` at which origin + t * direction meets the object.
inline std::optional<double> hit(const VirtualObject& o, const Eigen::Vector3d& origin,
                                 const Eigen::Vector3d& direction, double least) {
    const RigidTransform T_object_world = o.T_world_object.inverse();
    const Eigen::Vector3d half = 0.5 * o.size;
    const Eigen::Vector3d from = T_object_world * origin;
    const Eigen::Vector3d along = T_object_world.rotation * direction;
    std::vector<double> met;
    if (o.shape == VirtualShape::Sphere) {
        const Eigen::Vector3d f = from.cwiseQuotient(half), a = along.cwiseQuotient(half);
        const double b = f.dot(a) / a.squaredNorm();
        const double root = b * b - (f.squaredNorm() - 1) / a.squaredNorm();
        if (root > 0) met = {-b - std::sqrt(root), -b + std::sqrt(root)};
    } else if (o.shape == VirtualShape::Box) {
        const Eigen::Array3d p = (-half - from).cwiseQuotient(along);
        const Eigen::Array3d q = (half - from).cwiseQuotient(along);
        const double in = p.min(q).maxCoeff(), out = p.max(q).minCoeff();
        if (in < out) met = {in, out};
    } else {
        const double t = -from.z() / along.z();
        const Eigen::Vector3d p = from + t * along;
        if (std::abs(p.x()) < half.x() && std::abs(p.y()) < half.y()) met = {t};
    }
    for (const double t : met)
        if (t > least) return t;
    return {};
}

/// Depth z of each pixel [m]; 0 if the pixel shows no surface.
struct DepthPicture {
    Size size;
    std::vector<double> z;

    [[nodiscard]] double at(int x, int y) const {
        x = std::clamp(x, 0, size.width - 1);
        y = std::clamp(y, 0, size.height - 1);
        return z[static_cast<std::size_t>(y) * size.width + x];
    }
    [[nodiscard]] std::array<double, 2> around(int x, int y) const {
        std::array<double, 2> range{at(x, y), at(x, y)};
        for (int i = 0; i < 9; ++i) {
            const int row = i / 3;
            const double v = at(x + i % 3 - 1, y + row - 1);
            range = {std::min(range[0], v), std::max(range[1], v)};
        }
        return range;
    }
};

inline DepthPicture rayCast(const std::vector<VirtualObject>& objects,
                            const RigidTransform& T_world_video, const CameraModel& camera,
                            double near) {
    DepthPicture out{camera.size, {}};
    for (int y = 0; y < camera.size.height; ++y) {
        for (int x = 0; x < camera.size.width; ++x) {
            const Eigen::Vector3d ray =
                camera.unproject({static_cast<double>(x), static_cast<double>(y)}).homogeneous();
            double nearest = 0;
            for (const VirtualObject& o : objects) {
                const auto z =
                    hit(o, T_world_video.translation, T_world_video.rotation * ray, near);
                if (z && (nearest == 0 || *z < nearest)) nearest = *z;
            }
            out.z.push_back(nearest);
        }
    }
    return out;
}

}  // namespace mfar::twin
