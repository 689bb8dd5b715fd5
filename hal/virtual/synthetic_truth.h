#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/synthetic_scene.h"

/// Exact ground truth of a view of the world: rays cast in double precision through the exact lens,
/// not rendered pictures.
namespace mfar::synthetic {

/// A camera's pose and lens at one instant.
struct Viewpoint {
    CameraModel camera;
    RigidTransform T_world_camera;
    double t = 0;  ///< [s]
};

/// 1 / z per pixel [1/m], z along the optical axis. 0 where the ray hits nothing.
[[nodiscard]] FloatImage inverseDepth(const World& world, const Viewpoint& view);

/// Position in `to` of the point seen by each pixel of `from`, as an offset [px]; follows moving
/// objects. NaN where the point is occluded or outside the picture in `to`.
[[nodiscard]] FlowImage flowBetween(const World& world, const Viewpoint& from, const Viewpoint& to);

}  // namespace mfar::synthetic
