#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "pipeline/composite/virtual_object.h"

#include <opencv2/core.hpp>

#include <span>

namespace mfar::eval {

/// Depth along the camera's axis [m] at which the ray (x/z, y/z) enters the exact shape of an
/// object. 0 if the ray misses it.
[[nodiscard]] double surfaceDepth(const VirtualObject& object, const RigidTransform& T_world_camera,
                                  const Eigen::Vector2d& ray);

/// Masks of virtual objects, sampled at the centre of each video pixel: CV_8U of the video's size,
/// 255 where an object is.
struct VirtualTruth {
    cv::Mat silhouette;  ///< whole object, also where it is occluded
    cv::Mat visible;     ///< part that real objects do not occlude
    /// Pixels whose visibility needs accurate depth: the real surface is in front of the object, or
    /// behind it by less than a tenth of the object's depth.
    cv::Mat undecided;
};

/// `real`: inverse depth of the real scene [1/m], at the video's size; 0: nothing is there.
[[nodiscard]] VirtualTruth virtualTruth(std::span<const VirtualObject> objects,
                                        const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const FloatImage& real);

}  // namespace mfar::eval
