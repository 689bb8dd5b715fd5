#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/composite/virtual_object.h"

#include <Eigen/Geometry>

#include <array>
#include <limits>
#include <vector>

namespace mfar {

/// Bounds of the pixels that a piece of a surface covers, and the range of its z [m].
struct SurfaceExtent {
    Eigen::AlignedBox2d pixels;
    double nearest = std::numeric_limits<double>::max();
    double farthest = 0;

    /// Extends the bounds so that they contain a point. The point must not be nearer to the camera
    /// than the near plane. It is given as (w u, w v, w), see LensProjection.
    void extend(const Eigen::Vector3d& point);
    /// Extends the bounds so that they contain the part of the line from a to b that lies beyond
    /// the near plane. Both ends are given as (w u, w v, w), see LensProjection.
    void extendBySegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
};

/// Computes on the CPU which pixels and depths the triangles of virtual objects cover, without
/// their colours. Only the constructor allocates memory.
class ObjectProjection {
public:
    explicit ObjectProjection(const CameraModel& camera);

    /// Returns the extents of all triangles that lie at least partly beyond the near plane.
    /// Triangles outside the picture are included. The depth ranges allow for a GPU that rounds
    /// corners to 1/256 px. Returns no extents if the object's position relative to the camera or
    /// its size is not finite or is 100 km or more along an axis, if the rotation is not finite, or
    /// if a size is negative. The result is valid until the next call.
    const std::vector<SurfaceExtent>& operator()(const VirtualObject& object,
                                                 const RigidTransform& T_world_video);

    [[nodiscard]] const LensProjection& lens() const { return lens_; }
    [[nodiscard]] const ShapeMesh& mesh(VirtualShape shape) const {
        return meshes_[static_cast<std::size_t>(shape)];
    }

private:
    LensProjection lens_;
    std::array<ShapeMesh, kVirtualShapes> meshes_;
    std::vector<Eigen::Vector3d> projected_;
    std::vector<SurfaceExtent> extents_;
};

}  // namespace mfar
