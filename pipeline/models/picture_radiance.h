#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

struct SeenRadiance {
    Eigen::Vector3f direction;  ///< unit vector in world coordinates
    Eigen::Vector3f radiance;   ///< linear RGB; 1 is the picture's white
    float solidAngle = 0;       ///< [sr]
};

/// Divides a picture into a grid of cells, and computes the radiance that each cell shows from a
/// few of its pixels. The picture must be valid (requireSound()); it may have any format and is
/// treated as sRGB. The result replaces the content of `out`.
void seenRadiance(const ImageView& picture, const CameraModel& camera,
                  const RigidTransform& T_world_camera, std::vector<SeenRadiance>& out);

}  // namespace mfar
