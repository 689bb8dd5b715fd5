#pragma once

#include "base/geometry.h"
#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar::eval {

/// A picture for the evaluated methods, with the video camera's pose at the time of the picture.
struct Shot {
    cv::Mat picture;  ///< CV_8UC3, B G R, of the sensor's size
    Timestamp time;
    /// Empty if unknown. Both shots of a sample share an arbitrary world coordinate system.
    std::optional<Pose> pose = std::nullopt;
};

/// Poses of the video camera at the times of a frame and of its still.
struct PosePair {
    std::optional<Pose> frame, still;
};

/// Interpolates the recorded poses. A pose is empty if Recording::poseAt() finds none. Without
/// recorded poses, the video camera's coordinates at the still's time are the world's coordinates,
/// and a frame's pose is known only if its time equals the still's.
[[nodiscard]] PosePair posesOf(const Recording& recording, Timestamp frame, Timestamp still);

/// Maps video camera coordinates at the frame's time to still camera coordinates at the still's
/// time.
[[nodiscard]] RigidTransform stillFromFrame(const StereoRig& rig, const Pose& frame,
                                            const Pose& still);

/// Errors added to poses to test robustness: turned() rotates each frame's pose by `degrees` about
/// a random axis, which depends on `seed` and on the frame.
struct PoseNoise {
    double degrees = 0;
    std::uint64_t seed = 0;
};

/// Rotates the pose by noise.degrees about a random axis; all directions of the axis are equally
/// likely. The pose relative to any still is then wrong by exactly noise.degrees. Equal recordings,
/// times and seeds give the same axis.
[[nodiscard]] Pose turned(const Pose& pose, const PoseNoise& noise, std::string_view recording);

}  // namespace mfar::eval
