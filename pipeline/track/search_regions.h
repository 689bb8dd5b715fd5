#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/track/tag_detector.h"
#include "pipeline/track/tag_map.h"

#include <vector>

namespace mfar {

/// Where in the picture to search for the tags of the map: a rectangle around every tag that faces
/// the camera and whose middle is in the picture, with a margin for its quiet zone, for motion and
/// for three standard deviations of the predicted pose. Overlapping rectangles are merged.
/// `covariance`: of T_world_camera, in the camera's own frame.
[[nodiscard]] std::vector<PixelRect> searchRegions(const TagMap& map, const CameraModel& camera,
                                                   const RigidTransform& T_world_camera,
                                                   const Matrix6& covariance);

/// Total area [px].
[[nodiscard]] double areaOf(const std::vector<PixelRect>& regions);

}  // namespace mfar
