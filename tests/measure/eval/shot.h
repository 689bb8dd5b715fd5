#pragma once

#include "base/geometry.h"
#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar::eval {

/// A picture that methods get: unchanged from the sensor, with the pose of the video camera at the
/// time of the picture.
struct Shot {
    cv::Mat picture;  ///< CV_8UC3, B G R, in the sensor's size
    Timestamp time;
    /// Both shots of a sample share the world frame, which is otherwise arbitrary. Empty: the pose
    /// is unknown.
    std::optional<Pose> pose = std::nullopt;
};

/// The video camera's pose at the time of a frame and of its still.
struct PosePair {
    std::optional<Pose> frame, still;
};

/// The poses at these two times, interpolated between recorded poses; empty outside their time
/// range. If no poses are recorded, the view of the still is the world frame. A frame's pose is
/// then known only if frame and still have equal times: the rig gives it.
[[nodiscard]] PosePair posesOf(const Recording& recording, Timestamp frame, Timestamp still);

/// T_still_frame = [R|t]: maps video camera coordinates at the frame's time to still camera
/// coordinates at the still's time.
[[nodiscard]] RigidTransform stillFromFrame(const StereoRig& rig, const Pose& frame,
                                            const Pose& still);

/// Pose errors for tests of robustness: the pose of each frame is rotated about an axis of its own.
struct PoseNoise {
    double degrees = 0;      ///< the angle of every rotation; it is exact
    std::uint64_t seed = 0;  ///< another seed gives other axes
};

/// The pose of a camera that was rotated about a random axis; all directions are equally probable.
/// The relative pose to any still is then wrong by exactly this angle. Equal recording, time and
/// seed give the same axis.
[[nodiscard]] Pose turned(const Pose& pose, const PoseNoise& noise, std::string_view recording);

}  // namespace mfar::eval
