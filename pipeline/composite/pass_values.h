#pragma once

#include "base/camera_lens.h"
#include "pipeline/composite/lens_projection.h"
#include "pipeline/composite/pass_params.h"

namespace mfar {

/// Converts T to single precision for shaders. The result multiplies points by `scale` before it
/// applies T.
[[nodiscard]] inline params::Transform transformOf(const RigidTransform& T, double scale = 1) {
    const Eigen::Matrix3f r = (scale * T.rotation.toRotationMatrix()).cast<float>();
    const Eigen::Vector3f t = T.translation.cast<float>();
    return {{{r(0, 0), r(0, 1), r(0, 2), t[0]},
             {r(1, 0), r(1, 1), r(1, 2), t[1]},
             {r(2, 0), r(2, 1), r(2, 2), t[2]}}};
}

[[nodiscard]] inline params::Projection projectionOf(const LensProjection& projection) {
    return {.lens = lensOf(projection.camera),
            .rim = static_cast<float>(projection.rim),
            .rimRadial = static_cast<float>(projection.rimRadial),
            .nearPlane = static_cast<float>(LensProjection::kNear)};
}

[[nodiscard]] inline params::PixelBounds boundsOf(const PixelRect& r) {
    return {r.x0, r.y0, r.x1, r.y1};
}

}  // namespace mfar
