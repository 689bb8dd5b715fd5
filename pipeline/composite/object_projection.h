#pragma once

#include "pipeline/composite/lens_projection.h"
#include "pipeline/composite/virtual_object.h"

#include <Eigen/Geometry>

#include <array>
#include <limits>
#include <vector>

namespace mfar {

/// What a piece of surface covers of the picture, and of the space before the camera.
struct SurfaceExtent {
    Eigen::AlignedBox2d pixels;
    double nearest = std::numeric_limits<double>::max();  ///< z [m]
    double farthest = 0;

    /// By a point before the near plane, as LensProjection gives it: (w u, w v, w).
    void extend(const Eigen::Vector3d& point);
    /// By the part of a straight line that lies before the near plane, as the rasteriser clips it.
    /// Both ends likewise.
    void extendBySegment(const Eigen::Vector3d& a, const Eigen::Vector3d& b);
};

/// The triangles of virtual objects as a camera sees them, on the host: where they are, not what
/// they look like. Allocates in its constructor alone.
class ObjectProjection {
public:
    explicit ObjectProjection(const CameraModel& camera);

    /// Of every triangle that reaches before the near plane, within the picture or not, with the
    /// depth that a renderer may give its pixels: corners are rounded to 1/256 px there. Nothing
    /// for an object with a pose or size that is not finite or above 100 km, or a negative size.
    /// Valid until the next call.
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
