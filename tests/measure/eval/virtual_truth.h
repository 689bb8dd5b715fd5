#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "pipeline/composite/virtual_object.h"

#include <opencv2/core.hpp>

#include <span>

namespace mfar::eval {

/// Depth z along the camera's axis [m] at which the ray (x/z, y/z) first enters a virtual object.
/// Computed from the exact shape, not from triangles. 0: the ray misses the object.
[[nodiscard]] double surfaceDepth(const VirtualObject& object, const RigidTransform& T_world_camera,
                                  const Eigen::Vector2d& ray);

/// Where virtual objects are in the picture, sampled at the centre of each video pixel. CV_8U of
/// the video's size; 255: an object is there.
struct VirtualTruth {
    cv::Mat silhouette;  ///< the object, whether occluded or not
    cv::Mat visible;     ///< the part that real objects do not occlude
    /// Pixels whose visibility depends on accurate depth: the real surface lies in front of the
    /// object, or less than a tenth of its distance behind it.
    cv::Mat undecided;
};

/// `real`: inverse depth of the real scene [1/m], of the video's size; 0: nothing is there.
[[nodiscard]] VirtualTruth virtualTruth(std::span<const VirtualObject> objects,
                                        const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const FloatImage& real);

}  // namespace mfar::eval
