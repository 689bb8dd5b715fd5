#include "tests/measure/eval/shot.h"

#include <numbers>
#include <random>

namespace mfar::eval {
namespace {

/// FNV-1a hash. Unlike std::hash, it is equal on all platforms.
std::uint64_t hashOf(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

}  // namespace

PosePair posesOf(const Recording& recording, Timestamp frame, Timestamp still) {
    if (!recording.poses.empty()) return {recording.poseAt(frame), recording.poseAt(still)};
    PosePair out{std::nullopt, Pose{still, {}}};
    if (frame == still) out.frame = out.still;
    return out;
}

RigidTransform stillFromFrame(const StereoRig& rig, const Pose& frame, const Pose& still) {
    return rig.T_still_video * still.T_world_video.inverse() * frame.T_world_video;
}

Pose turned(const Pose& pose, const PoseNoise& noise, std::string_view recording) {
    std::mt19937_64 random(hashOf(recording) ^ static_cast<std::uint64_t>(pose.time.ns) ^
                           (noise.seed * 0x9e3779b97f4a7c15));
    std::normal_distribution<double> normal;
    Eigen::Vector3d axis;
    do
        axis = {normal(random), normal(random), normal(random)};
    while (!(axis.norm() > 1e-3));
    Pose out = pose;
    const Eigen::AngleAxisd turn(noise.degrees * std::numbers::pi / 180, axis.normalized());
    out.T_world_video.rotation = (pose.T_world_video.rotation * turn).normalized();
    return out;
}

}  // namespace mfar::eval
