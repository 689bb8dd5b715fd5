#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

/// Light that a camera saw from one direction.
struct SeenRadiance {
    Eigen::Vector3f direction;  ///< unit vector, world
    Eigen::Vector3f radiance;   ///< linear RGB; 1 is the picture's white
    float solidAngle = 0;       ///< [sr]
};

/// A picture's radiance in a grid of cells, each the mean of a few of its pixels. The picture must
/// be valid (requireSound()), of any format, sRGB. `out` is replaced.
void seenRadiance(const ImageView& picture, const CameraModel& camera,
                  const RigidTransform& T_world_camera, std::vector<SeenRadiance>& out);

}  // namespace mfar
