#pragma once

#include "base/geometry.h"

namespace mfar {

/// A camera's projection, continued to all points of space so that triangles can be clipped after
/// it. Within the rim of the lens it is CameraModel::project. Beyond the rim, where the lens model
/// would fold back into the picture, pixels continue outwards in proportion to the ray. Its twin is
/// lens_projection.glsl.
struct LensProjection {
    static constexpr double kNear = 0.01;  ///< near plane [m]: nothing nearer is drawn

    explicit LensProjection(const CameraModel& model);

    /// Camera coordinates [m] to (w u, w v, w) for pixel (u, v) [px], with w = z of any sign.
    [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;

    CameraModel camera;
    double rim;        ///< radius of the outermost ray (x/z, y/z) for which the lens model is valid
    double rimRadial;  ///< radial factor of the distortion at the rim
};

}  // namespace mfar
