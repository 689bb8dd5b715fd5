#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/track/tag_detector.h"
#include "pipeline/track/tag_map.h"

#include <vector>

namespace mfar {

/// Returns a rectangle around every tag of the map that faces the camera, whose centre is in the
/// picture, and that appears large enough to be found. The margin suffices for the tag's white
/// border, the tag's motion, and three standard deviations of the predicted pose. Overlapping
/// rectangles are merged. `covariance` is the covariance of T_world_camera in camera coordinates.
[[nodiscard]] std::vector<PixelRect> searchRegions(const TagMap& map, const CameraModel& camera,
                                                   const RigidTransform& T_world_camera,
                                                   const Matrix6& covariance);

[[nodiscard]] double areaOf(const std::vector<PixelRect>& regions);

}  // namespace mfar
