#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "pipeline/composite/virtual_object.h"

#include <opencv2/core.hpp>

#include <span>

namespace mfar::eval {

/// z [m] along the camera's axis of the first surface of a virtual object that the ray (x/z, y/z)
/// meets from outside, computed from the exact shape, not from triangles. 0: the ray misses.
[[nodiscard]] double surfaceDepth(const VirtualObject& object, const RigidTransform& T_world_camera,
                                  const Eigen::Vector2d& ray);

/// Where virtual objects are in the picture, at the centre of each video pixel. CV_8U of the
/// video's size, 255 = there.
struct VirtualTruth {
    cv::Mat silhouette;  ///< occluded or not
    cv::Mat visible;     ///< not occluded by real objects
    /// Pixels where visibility depends on accurate depth: the real surface is in front of the
    /// object, or behind it by less than a tenth of its distance.
    cv::Mat undecided;
};

/// `real`: inverse depth of the scene [1/m], 0 = nothing there; of the video's size.
[[nodiscard]] VirtualTruth virtualTruth(std::span<const VirtualObject> objects,
                                        const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const FloatImage& real);

}  // namespace mfar::eval
