#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

struct SeenRadiance {
    Eigen::Vector3f direction;  ///< unit vector in world coordinates
    Eigen::Vector3f radiance;   ///< linear RGB; 1 is the picture's white
    float solidAngle = 0;
};

/// Computes the radiance that a picture shows, in a grid of cells, from a few pixels of each. The
/// picture must be valid (requireSound()); it may have any format and is treated as sRGB. The
/// result replaces the content of `out`.
void seenRadiance(const ImageView& picture, const CameraModel& camera,
                  const RigidTransform& T_world_camera, std::vector<SeenRadiance>& out);

}  // namespace mfar
