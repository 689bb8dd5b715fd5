#pragma once

#include "base/geometry.h"

namespace mfar {

/// A camera's projection continued to all points of space, so that triangles can be clipped after
/// it: within the rim of the lens it is CameraModel::project; beyond, where the model would fold
/// back into the picture, pixels go on outwards in proportion to the ray. Its twin is
/// lens_projection.glsl.
struct LensProjection {
    static constexpr double kNear = 0.01;  ///< [m]: nothing nearer is drawn

    explicit LensProjection(const CameraModel& model);

    /// Camera coordinates [m] to (w u, w v, w): pixel (u, v) [px], w = z, of any sign.
    [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const;

    CameraModel camera;
    double rim;        ///< radius of the outermost ray (x/z, y/z) that the model describes
    double rimRadial;  ///< radial factor of the distortion there
};

}  // namespace mfar
