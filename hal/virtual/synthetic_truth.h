#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/synthetic_scene.h"

/// Exact ground truth of the world. It is computed with rays in double precision and the exact lens
/// model, not from rendered pictures.
namespace mfar::synthetic {

struct Viewpoint {
    CameraModel camera;
    RigidTransform T_world_camera;
    double t = 0;
};

/// Returns the inverse depth 1 / z of each pixel [1/m], with z along the optical axis. 0: the ray
/// hits nothing.
[[nodiscard]] FloatImage inverseDepth(const World& world, const Viewpoint& view);

/// Returns, for each pixel of `from`, the offset [px] to the same point in `to`. If an object has
/// moved, its points are followed. NaN: the pixel shows the background, or the point is occluded in
/// `to` or outside of that picture.
[[nodiscard]] FlowImage flowBetween(const World& world, const Viewpoint& from, const Viewpoint& to);

}  // namespace mfar::synthetic
