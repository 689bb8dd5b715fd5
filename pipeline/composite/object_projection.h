#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/composite/virtual_object.h"

#include <Eigen/Geometry>

#include <array>
#include <limits>
#include <vector>

namespace mfar {

/// The bounds of the pixels that a piece of a surface covers, and the range of its z.
struct SurfaceExtent {
    Eigen::AlignedBox2d pixels;
    double nearest = std::numeric_limits<double>::max();  ///< smallest z [m]
    double farthest = 0;

    /// Extends the bounds and the range by a point beyond the near plane. The point is given as (w
    /// u, w v, w), see LensProjection.
    void extend(const Eigen::Vector3d& point);
    /// Extends the bounds and the range by the part of a line from a to b that is beyond the near
    /// plane, as a rasteriser clips it. Both ends are given as (w u, w v, w).
    void extendBySegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
};

/// Projects the triangles of virtual objects on the CPU. Computes only which pixels and depths they
/// cover, not their colours. Allocates only in its constructor.
class ObjectProjection {
public:
    explicit ObjectProjection(const CameraModel& camera);

    /// Returns the extents of all triangles that lie at least partly beyond the near plane, even
    /// outside the picture. The ranges of depth include the error of a GPU that rounds corners to
    /// 1/256 px. Returns no extents if the object's pose or size is not finite or exceeds 100 km,
    /// or if a size is negative. The result is valid until the next call.
    const std::vector<SurfaceExtent>& operator()(const VirtualObject& object,
                                                 const RigidTransform& T_world_video);

    [[nodiscard]] const LensProjection& lens() const { return lens_; }
    [[nodiscard]] const ShapeMesh& mesh(VirtualShape shape) const {
        return meshes_[static_cast<std::size_t>(shape)];
    }

private:
    LensProjection lens_;
    std::array<ShapeMesh, kVirtualShapes> meshes_;
    std::vector<Eigen::Vector3d> projected_;  // (w u, w v, w)
    std::vector<SurfaceExtent> extents_;
};

}  // namespace mfar
