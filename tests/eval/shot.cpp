#include "tests/eval/shot.h"

#include <numbers>
#include <random>

namespace mfar::eval {

PosePair posesOf(const Recording& recording, Timestamp frame, Timestamp still) {
    if (!recording.poses.empty()) return {recording.poseAt(frame), recording.poseAt(still)};
    PosePair out{std::nullopt, Pose{still, {}}};
    if (frame == still) out.frame = out.still;
    return out;
}

RigidTransform stillFromFrame(const StereoRig& rig, const Pose& frame, const Pose& still) {
    return rig.T_still_video * still.T_world_video.inverse() * frame.T_world_video;
}

Pose turned(const Pose& pose, double degrees, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Eigen::Vector3d axis;
    do
        axis = {normal(random), normal(random), normal(random)};
    while (!(axis.norm() > 1e-3));
    Pose out = pose;
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, axis.normalized());
    out.T_world_video.rotation = (pose.T_world_video.rotation * turn).normalized();
    return out;
}

}  // namespace mfar::eval
