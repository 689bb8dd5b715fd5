#pragma once

#include "base/geometry.h"
#include "hal/virtual/recording.h"

#include <opencv2/core.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar::eval {

/// A picture as a method gets it: as its sensor took it, with where the video camera was then.
struct Shot {
    cv::Mat picture;  ///< CV_8UC3, B G R, of its sensor's size
    Timestamp time;
    /// World is any frame that both shots of a sample share. Nothing: not known.
    std::optional<Pose> pose = std::nullopt;
};

/// The video camera's pose at the time of a frame and of its still.
struct PosePair {
    std::optional<Pose> frame, still;
};

/// From the recorded poses, nothing where they do not reach. Without any, the still's view is the
/// world: known of a frame at the still's very time, where the rig alone says the rest.
[[nodiscard]] PosePair posesOf(const Recording& recording, Timestamp frame, Timestamp still);

/// [R|t] of design.md, section 3: video camera coordinates at the frame's time -> still camera
/// coordinates at the still's time.
[[nodiscard]] RigidTransform stillFromFrame(const StereoRig& rig, const Pose& frame,
                                            const Pose& still);

/// Poses that are off: each frame's is turned about an axis of its own.
struct PoseNoise {
    double degrees = 0;      ///< each frame's by exactly so much
    std::uint64_t seed = 0;  ///< another seed, other axes
};

/// The pose of a camera turned about an axis drawn evenly from all directions: the relative pose to
/// any still is off by exactly the angle. Same recording, time and seed: same axis.
[[nodiscard]] Pose turned(const Pose& pose, const PoseNoise& noise, std::string_view recording);

}  // namespace mfar::eval
