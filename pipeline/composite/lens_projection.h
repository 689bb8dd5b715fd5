#pragma once

#include "base/geometry.h"

namespace mfar {

/// A camera's projection that is defined for all points in space, so that projected triangles can
/// be clipped. For rays inside a certain radius (the rim), it equals CameraModel::project. Beyond
/// the rim, the lens model could fold points back into the picture. So beyond the rim, the pixel's
/// distance from the centre grows linearly with the ray's radius. lens_projection.glsl implements
/// the same projection.
struct LensProjection {
    static constexpr double kNear = 0.01;  ///< z of the near plane [m]

    explicit LensProjection(const CameraModel& model);

    /// Maps camera coordinates [m] to (w u, w v, w), where (u, v) is the pixel [px] and w = z,
    /// which may have any sign.
    [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;

    CameraModel camera;
    double rim;        ///< radius of the rays (x/z, y/z) up to which the lens model is used
    double rimRadial;  ///< factor by which radial distortion lengthens a ray at the rim
};

}  // namespace mfar
