#pragma once

#include "base/geometry.h"

#include <vector>

namespace mfar {

/// Light that the camera received from one direction.
struct SeenRadiance {
    Eigen::Vector3f direction;  ///< unit vector in the world
    Eigen::Vector3f radiance;   ///< linear RGB; a radiance of 1 is the picture's white
    float solidAngle = 0;       ///< solid angle from which the light came [sr]
};

/// Computes the radiance that a picture shows, in a grid of cells. The radiance of a cell is the
/// mean of a few of its pixels. The picture must be valid (requireSound()); it may have any format
/// and is treated as sRGB. The result replaces the content of `out`.
void seenRadiance(const ImageView& picture, const CameraModel& camera,
                  const RigidTransform& T_world_camera, std::vector<SeenRadiance>& out);

}  // namespace mfar
