#pragma once

#include "daemon/tools/calibrate/pose_track.h"

#include <vector>

namespace mfar::calibration {

struct StillPose {
    Timestamp time;
    RigidTransform T_still_target;
};

struct RigStart {
    RigidTransform T_still_video;
    double offset = 0;  ///< [s] still's time + offset = time on the video's clock
    int stills = 0;
};

/// Returns first estimates of the extrinsics and of the clock offset. The offset is searched
/// between -maxOffset and maxOffset [s]. At the right offset, the extrinsics that are computed from
/// the single stills agree best. At a wrong offset they differ, because the camera moved.
[[nodiscard]] RigStart startOfRig(const PoseTrack& video, const std::vector<StillPose>& stills,
                                  double maxOffset);

}  // namespace mfar::calibration
