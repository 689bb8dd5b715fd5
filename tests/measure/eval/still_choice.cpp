#include "tests/measure/eval/still_choice.h"

#include <chrono>

namespace mfar::eval {
namespace {

constexpr double kSameView = 1e-6;

bool isIdentity(const RigidTransform& t) {
    return t.translation.norm() < kSameView &&
           t.rotation.angularDistance(Eigen::Quaterniond::Identity()) < kSameView;
}

std::optional<std::size_t> nearestStill(const Recording& recording, Timestamp frame,
                                        std::optional<std::size_t> but) {
    std::optional<std::size_t> best;
    std::chrono::nanoseconds nearest{};
    for (std::size_t i = 0; i < recording.stills.size(); ++i) {
        const Timestamp time = recording.stills[i].time;
        const auto distance = std::chrono::abs(time - frame);
        if (i == but || (best && distance >= nearest)) continue;
        if (showsOwnView(recording, time, frame)) continue;
        best = i;
        nearest = distance;
    }
    return best;
}

}  // namespace

bool showsOwnView(const Recording& recording, Timestamp still, Timestamp frame) {
    if (still == frame) return isIdentity(recording.rig.T_still_video);
    const auto from = recording.poseAt(frame), to = recording.poseAt(still);
    if (!from || !to) return false;
    return isIdentity(recording.rig.T_still_video * to->T_world_video.inverse() *
                      from->T_world_video);
}

std::optional<std::size_t> referenceStill(const Recording& recording, Timestamp frame) {
    return nearestStill(recording, frame, {});
}

std::optional<std::size_t> secondStill(const Recording& recording, Timestamp frame) {
    return nearestStill(recording, frame, referenceStill(recording, frame));
}

}  // namespace mfar::eval
