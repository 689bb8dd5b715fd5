#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

/// Light that the camera saw from one direction.
struct SeenRadiance {
    Eigen::Vector3f direction;  ///< unit vector in the world
    Eigen::Vector3f radiance;   ///< linear RGB; a radiance of 1 is the picture's white
    float solidAngle = 0;       ///< [sr]
};

/// Radiance of a picture in a grid of cells. Each cell is the mean of a few of its pixels. The
/// picture must be valid (requireSound()); it may have any format and is treated as sRGB. The old
/// content of `out` is replaced.
void seenRadiance(const ImageView& picture, const CameraModel& camera,
                  const RigidTransform& T_world_camera, std::vector<SeenRadiance>& out);

}  // namespace mfar
