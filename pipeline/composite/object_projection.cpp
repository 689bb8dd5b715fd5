#include "pipeline/composite/object_projection.h"

#include "pipeline/se3.h"

#include <algorithm>

namespace mfar {
namespace {

bool isPlausible(const Eigen::Vector3d& metres) {
    constexpr double kFarthest = 1e5;  // single precision ends in pixels beyond
    return (metres.array().abs() < kFarthest).all();
}

}  // namespace

void SurfaceExtent::extendBySegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    constexpr double kNear = LensProjection::kNear;
    const auto extend = [this](const Eigen::Vector3d& h) {
        pixels.extend(Eigen::Vector2d(h.hnormalized()));
        nearest = std::min(nearest, h.z());
        farthest = std::max(farthest, h.z());
    };
    if (a.z() >= kNear) extend(a);
    if (b.z() >= kNear) extend(b);
    if ((a.z() >= kNear) == (b.z() >= kNear)) return;
    Eigen::Vector3d cut = a + (b - a) * ((kNear - a.z()) / (b.z() - a.z()));
    cut.z() = kNear;
    extend(cut);
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
        SurfaceExtent extent;
        for (std::size_t i = 0; i < 3; ++i)
            extent.extendBySegment(projected_[t[i]], projected_[t[(i + 1) % 3]]);
        if (!extent.pixels.isEmpty()) extents_.push_back(extent);
    }
    return extents_;
}

}  // namespace mfar
