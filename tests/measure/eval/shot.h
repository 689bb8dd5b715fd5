#pragma once

#include "base/geometry.h"
#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar::eval {

/// A picture as a method gets it: as its sensor took it, with the pose of the video camera at that
/// time.
struct Shot {
    cv::Mat picture;  ///< CV_8UC3, B G R, of its sensor's size
    Timestamp time;
    /// World is any frame that both shots of a sample share. Empty: unknown.
    std::optional<Pose> pose = std::nullopt;
};

/// The video camera's pose at the time of a frame and of its still.
struct PosePair {
    std::optional<Pose> frame, still;
};

/// From the recorded poses; empty outside their time range. Without recorded poses, the still's
/// view is the world: a frame's pose is known only at the still's very time, from the rig.
[[nodiscard]] PosePair posesOf(const Recording& recording, Timestamp frame, Timestamp still);

/// [R|t] of design.md, section 3: video camera coordinates at the frame's time -> still camera
/// coordinates at the still's time.
[[nodiscard]] RigidTransform stillFromFrame(const StereoRig& rig, const Pose& frame,
                                            const Pose& still);

/// Pose errors: each frame's pose is rotated about its own axis.
struct PoseNoise {
    double degrees = 0;      ///< exact angle of each frame's rotation
    std::uint64_t seed = 0;  ///< another seed gives other axes
};

/// The pose of a camera rotated about an axis drawn uniformly from all directions: the relative
/// pose to any still is wrong by exactly the angle. Equal recording, time and seed give the same
/// axis.
[[nodiscard]] Pose turned(const Pose& pose, const PoseNoise& noise, std::string_view recording);

}  // namespace mfar::eval
