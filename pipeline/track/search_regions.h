#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/track/tag_detector.h"
#include "pipeline/track/tag_map.h"

#include <vector>

namespace mfar {

/// Returns the rectangles in which the tags of the map must be searched. There is one for each tag
/// that faces the camera, whose centre is in the picture, and that appears large enough to be
/// found. Each includes a margin for the tag's white border, for three standard deviations of the
/// predicted pose, and for errors that the prediction does not model. If the prediction is too
/// uncertain for a tag, its rectangle is the whole picture. Overlapping rectangles are merged.
/// `covariance` is the covariance of T_world_camera in camera coordinates.
[[nodiscard]] std::vector<PixelRect> searchRegions(const TagMap& map, const CameraModel& camera,
                                                   const RigidTransform& T_world_camera,
                                                   const Matrix6& covariance);

[[nodiscard]] double areaOf(const std::vector<PixelRect>& regions);

}  // namespace mfar
