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
    int stills = 0;     ///< number of stills within the video's time
};

/// Initial extrinsics, and the offset of the clocks within +-maxOffset [s] at which the stills
/// agree best about the extrinsics: at a wrong offset the camera's motion spreads them.
[[nodiscard]] RigStart startOfRig(const PoseTrack& video, const std::vector<StillPose>& stills,
                                  double maxOffset);

}  // namespace mfar::calibration
