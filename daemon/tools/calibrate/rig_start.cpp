#include "daemon/tools/calibrate/rig_start.h"

#include "base/se3.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar::calibration {
namespace {

Timestamp later(Timestamp t, double seconds) {
    return {t.ns + static_cast<std::int64_t>(std::llround(seconds * 1e9))};
}

struct Agreement {
    /// Median difference between T_still_video and the results from the single stills [rad].
    double spread = std::numeric_limits<double>::infinity();
    RigidTransform T_still_video;
    int stills = 0;
};

/// For one clock offset, computes T_still_video from each still. Returns the result whose median
/// difference from the others is smallest, so that outliers do not matter.
Agreement agreementAt(const PoseTrack& video, const std::vector<StillPose>& stills, double offset) {
    std::vector<RigidTransform> candidates;
    double distance = 0;
    for (const StillPose& still : stills) {
        const auto T_video_target = video.at(later(still.time, offset));
        if (!T_video_target) continue;
        candidates.push_back(still.T_still_target * T_video_target->inverse());
        distance += T_video_target->translation.norm();
    }
    Agreement out;
    out.stills = static_cast<int>(candidates.size());
    distance /= std::max(1, out.stills);
    for (const RigidTransform& middle : candidates) {
        std::vector<double> away;
        for (const RigidTransform& other : candidates) {
            const Vector6 d = logarithm(middle.inverse() * other);
            away.push_back(d.head<3>().norm() + d.tail<3>().norm() / distance);
        }
        const auto median = away.begin() + static_cast<std::ptrdiff_t>(away.size() / 2);
        std::nth_element(away.begin(), median, away.end());
        if (!(*median < out.spread)) continue;
        out.spread = *median;
        out.T_still_video = middle;
    }
    return out;
}

}  // namespace

RigStart startOfRig(const PoseTrack& video, const std::vector<StillPose>& stills,
                    double maxOffset) {
    RigStart out;
    Agreement best;
    const double step = std::max(1e-3, video.interval() / 8);
    // The search begins at offset 0, and another offset must give a smaller spread to replace it.
    // If nothing moved, no other offset gives a smaller spread, so the result is 0.
    for (int i = 0; i * step <= maxOffset; ++i) {
        for (const double offset : {i * step, -i * step}) {
            const Agreement now = agreementAt(video, stills, offset);
            // An offset is refused if it moves many stills to times before or after the video. The
            // few stills that remain would agree by chance.
            if (now.stills * 4 < best.stills * 3 || !(now.spread < best.spread)) continue;
            best = now;
            out = {now.T_still_video, offset, now.stills};
        }
    }
    return out;
}

}  // namespace mfar::calibration
