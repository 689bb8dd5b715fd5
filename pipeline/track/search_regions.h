#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/track/tag_detector.h"
#include "pipeline/track/tag_map.h"

#include <vector>

namespace mfar {

/// Returns the parts of the picture in which the tags of the map are searched: a rectangle around
/// every tag that faces the camera and whose centre is in the picture. The margin of a rectangle is
/// large enough for the tag's quiet zone, its motion, and three standard deviations of the
/// predicted pose. Overlapping rectangles are merged. `covariance`: covariance of T_world_camera,
/// in camera coordinates.
[[nodiscard]] std::vector<PixelRect> searchRegions(const TagMap& map, const CameraModel& camera,
                                                   const RigidTransform& T_world_camera,
                                                   const Matrix6& covariance);

/// Total area of the regions [px^2].
[[nodiscard]] double areaOf(const std::vector<PixelRect>& regions);

}  // namespace mfar
