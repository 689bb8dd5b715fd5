#pragma once

#include "base/geometry.h"
#include "hal/virtual/image_files.h"
#include "pipeline/composite/virtual_object.h"

#include <opencv2/core.hpp>

#include <span>

namespace mfar::eval {

/// z [m] along the camera's axis of the first surface of a virtual object that the ray (x/z, y/z)
/// meets from outside, from the shape itself and not from its triangles. 0: it meets none.
[[nodiscard]] double surfaceDepth(const VirtualObject& object, const RigidTransform& T_world_camera,
                                  const Eigen::Vector2d& ray);

/// Where virtual objects are in the picture, at the middle of each video pixel. CV_8U of the
/// video's size, 255 = there.
struct VirtualTruth {
    cv::Mat silhouette;  ///< hidden or not
    cv::Mat visible;     ///< what no real thing hides
    /// Where it takes depth to tell: the real surface is before the object or less than a tenth of
    /// its distance behind.
    cv::Mat undecided;
};

/// `real`: 1/z of the scene [1/m], 0 = nothing there; of the video's size.
[[nodiscard]] VirtualTruth virtualTruth(std::span<const VirtualObject> objects,
                                        const CameraModel& video,
                                        const RigidTransform& T_world_video,
                                        const FloatImage& real);

}  // namespace mfar::eval
