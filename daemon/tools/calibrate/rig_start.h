#pragma once

#include "daemon/tools/calibrate/pose_track.h"

#include <vector>

namespace mfar::calibration {

/// Pose of the target in one still, T_still_target.
struct StillPose {
    Timestamp time;
    RigidTransform T_still_target;
};

struct RigStart {
    RigidTransform T_still_video;
    double offset = 0;  ///< [s] still's time + offset = video's time
    int stills = 0;     ///< whose time the video covers
};

/// How the sensors stand to each other, and the offset of their clocks within +-maxOffset [s] for
/// which all stills agree the best about it: at any other the camera's motion spreads them.
[[nodiscard]] RigStart startOfRig(const PoseTrack& video, const std::vector<StillPose>& stills,
                                  double maxOffset);

}  // namespace mfar::calibration
