#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/synthetic_scene.h"

/// What can be known exactly about a view of the world: rays cast in double precision through the
/// exact lens, not rendered pictures.
namespace mfar::synthetic {

/// A camera somewhere at one instant.
struct Viewpoint {
    CameraModel camera;
    RigidTransform T_world_camera;
    double t = 0;  ///< [s]
};

/// 1 / z per pixel [1/m], z along the optical axis. 0 where the ray hits nothing.
[[nodiscard]] FloatImage inverseDepth(const World& world, const Viewpoint& view);

/// Where the point seen by each pixel of `from` appears in `to`, as an offset [px]; things that
/// move by themselves are followed. Unknown (NaN) where it is hidden or outside the picture there.
[[nodiscard]] FlowImage flowBetween(const World& world, const Viewpoint& from, const Viewpoint& to);

}  // namespace mfar::synthetic
