#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/track/tag_detector.h"
#include "pipeline/track/tag_map.h"

#include <vector>

namespace mfar {

/// The parts of the picture in which the tags of the map are searched. There is a rectangle around
/// every tag that faces the camera and whose centre is in the picture. Its margin covers the tag's
/// quiet zone, motion, and three standard deviations of the predicted pose. Overlapping rectangles
/// are merged. `covariance` is that of T_world_camera, in the camera's own frame.
[[nodiscard]] std::vector<PixelRect> searchRegions(const TagMap& map, const CameraModel& camera,
                                                   const RigidTransform& T_world_camera,
                                                   const Matrix6& covariance);

/// Total area [px^2].
[[nodiscard]] double areaOf(const std::vector<PixelRect>& regions);

}  // namespace mfar
