#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/composite/virtual_object.h"

#include <Eigen/Geometry>

#include <array>
#include <limits>
#include <vector>

namespace mfar {

/// The area of the picture that a piece of surface covers, and its range of z.
struct SurfaceExtent {
    Eigen::AlignedBox2d pixels;
    double nearest = std::numeric_limits<double>::max();  ///< z [m]
    double farthest = 0;

    /// Includes a point beyond the near plane, in the form of LensProjection: (w u, w v, w).
    void extend(const Eigen::Vector3d& point);
    /// Includes the part of a straight line beyond the near plane, as the rasteriser clips it. Both
    /// ends have the form of LensProjection.
    void extendBySegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
};

/// Projects the triangles of virtual objects on the host: only their extents, not their colours.
/// Allocates only in its constructor.
class ObjectProjection {
public:
    explicit ObjectProjection(const CameraModel& camera);

    /// Extents of every triangle that is at least partly beyond the near plane, inside the picture
    /// or not. Depths include the error of a renderer, which rounds corners to 1/256 px. Empty for
    /// an object whose pose or size is not finite or above 100 km, or whose size is negative. Valid
    /// until the next call.
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
