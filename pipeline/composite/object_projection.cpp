#include "pipeline/composite/object_projection.h"

#include "base/se3.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

bool isPlausible(const Eigen::Vector3d& metres) {
    constexpr double kFarthest = 1e5;  // [m]; single precision cannot resolve pixels beyond it
    return (metres.array().abs() < kFarthest).all();
}

/// Returns the intersection of the line through a and b with the near plane. Points are given as
/// (w u, w v, w).
Eigen::Vector3d nearCut(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    constexpr double kNear = LensProjection::kNear;
    Eigen::Vector3d cut = a + (b - a) * ((kNear - a.z()) / (b.z() - a.z()));
    cut.z() = kNear;
    return cut;
}

// kGrid: a GPU rounds the corners of triangles to this grid [px], which changes the depth between
// the corners. kFarthest: all surfaces are nearer than this [m].
constexpr double kGrid = 1.0 / 256;
constexpr double kFarthest = 3e5;

struct Clipped {
    std::array<Eigen::Vector3d, 4> corners;
    std::size_t count = 0;

    [[nodiscard]] Eigen::Vector2d pixel(std::size_t i) const {
        return corners[i % count].hnormalized();
    }
};

Clipped clipped(const std::array<Eigen::Vector3d, 3>& triangle) {
    constexpr double kNear = LensProjection::kNear;
    Clipped out;
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3d &a = triangle[i], &b = triangle[(i + 1) % 3];
        if (a.z() >= kNear) out.corners[out.count++] = a;
        if ((a.z() >= kNear) != (b.z() >= kNear)) out.corners[out.count++] = nearCut(a, b);
    }
    return out;
}

double leastWidth(const Clipped& polygon) {
    double area = 0, longest = 0;
    const Eigen::Vector2d origin = polygon.pixel(0);
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const Eigen::Vector2d a = polygon.pixel(i) - origin, b = polygon.pixel(i + 1) - origin;
        area += 0.5 * (a.x() * b.y() - a.y() * b.x());
        for (std::size_t j = 0; j < i; ++j)
            longest = std::max(longest, (polygon.pixel(j) - polygon.pixel(i)).norm());
    }
    return longest > 0 ? std::abs(area) / longest : 0;
}

SurfaceExtent extentOf(const Clipped& polygon) {
    SurfaceExtent out;
    for (std::size_t i = 0; i < polygon.count; ++i)
        out.extend(polygon.corners[i]);
    if (out.pixels.isEmpty()) return out;
    const double nearest = 1 / out.nearest, farthest = 1 / out.farthest;
    const double off = (nearest - farthest) * kGrid / std::max(leastWidth(polygon), kGrid);
    out.nearest = 1 / (nearest + off);
    out.farthest = std::max(out.farthest, 1 / std::max(farthest - off, 1 / kFarthest));
    return out;
}

}  // namespace

void SurfaceExtent::extend(const Eigen::Vector3d& point) {
    pixels.extend(Eigen::Vector2d(point.hnormalized()));
    nearest = std::min(nearest, point.z());
    farthest = std::max(farthest, point.z());
}

void SurfaceExtent::extendBySegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    constexpr double kNear = LensProjection::kNear;
    if (a.z() >= kNear) extend(a);
    if (b.z() >= kNear) extend(b);
    if ((a.z() >= kNear) != (b.z() >= kNear)) extend(nearCut(a, b));
}

ObjectProjection::ObjectProjection(const CameraModel& camera)
    : lens_(camera), meshes_{shapeMesh(VirtualShape::Box), shapeMesh(VirtualShape::Sphere),
                             shapeMesh(VirtualShape::Quad)} {
    for (const ShapeMesh& mesh : meshes_) {
        projected_.reserve(std::max(projected_.capacity(), mesh.vertices.size()));
        extents_.reserve(std::max(extents_.capacity(), mesh.triangles.size()));
    }
}

const std::vector<SurfaceExtent>&
ObjectProjection::operator()(const VirtualObject& object, const RigidTransform& T_world_video) {
    projected_.clear();
    extents_.clear();
    const RigidTransform T_video_object = T_world_video.inverse() * object.T_world_object;
    if (!isFinite(T_video_object) || !isPlausible(T_video_object.translation) ||
        !isPlausible(object.size) || !(object.size.array() >= 0).all())
        return extents_;
    const Eigen::Matrix3d axes =
        T_video_object.rotation.toRotationMatrix() * object.size.asDiagonal();
    for (const ShapeMesh::Vertex& v : mesh(object.shape).vertices)
        projected_.push_back(lens_(axes * v.position.cast<double>() + T_video_object.translation));
    for (const auto& t : mesh(object.shape).triangles) {
        const SurfaceExtent extent =
            extentOf(clipped({projected_[t[0]], projected_[t[1]], projected_[t[2]]}));
        if (!extent.pixels.isEmpty()) extents_.push_back(extent);
    }
    return extents_;
}

}  // namespace mfar
