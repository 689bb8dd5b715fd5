#include "pipeline/composite/object_projection.h"

#include "pipeline/se3.h"

#include <algorithm>
#include <limits>

namespace mfar {
namespace {

bool isPlausible(const Eigen::Vector3d& metres) {
    constexpr double kFarthest = 1e5;  // single precision ends in pixels beyond
    return (metres.array().abs() < kFarthest).all();
}

/// Of (w u, w v, w) at or before the near plane.
void extend(TriangleExtent& extent, const Eigen::Vector3d& h) {
    extent.pixels.extend(Eigen::Vector2d(h.hnormalized()));
    extent.nearest = std::min(extent.nearest, h.z());
    extent.farthest = std::max(extent.farthest, h.z());
}

/// Clipped at the near plane, as the rasteriser does it. Empty box: all of it lies behind.
TriangleExtent extentOf(const std::array<Eigen::Vector3d, 3>& corners) {
    constexpr double kNear = LensProjection::kNear;
    TriangleExtent extent{{}, std::numeric_limits<double>::max(), 0};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if (a.z() >= kNear) extend(extent, a);
        if ((a.z() >= kNear) == (b.z() >= kNear)) continue;
        Eigen::Vector3d cut = a + (b - a) * ((kNear - a.z()) / (b.z() - a.z()));
        cut.z() = kNear;
        extend(extent, cut);
    }
    return extent;
}

}  // namespace

ObjectProjection::ObjectProjection(const CameraModel& camera)
    : lens_(camera), meshes_{shapeMesh(VirtualShape::Box), shapeMesh(VirtualShape::Sphere),
                             shapeMesh(VirtualShape::Quad)} {
    for (const ShapeMesh& mesh : meshes_) {
        projected_.reserve(std::max(projected_.capacity(), mesh.vertices.size()));
        extents_.reserve(std::max(extents_.capacity(), mesh.triangles.size()));
    }
}

const std::vector<TriangleExtent>&
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
        const TriangleExtent extent =
            extentOf({projected_[t[0]], projected_[t[1]], projected_[t[2]]});
        if (!extent.pixels.isEmpty()) extents_.push_back(extent);
    }
    return extents_;
}

}  // namespace mfar
