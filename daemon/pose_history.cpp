#include "daemon/pose_history.h"

#include "base/se3.h"

namespace mfar {
namespace {

/// Returns the camera's mean velocity between the poses a and b, in the camera's frame [rad/s,
/// m/s].
Vector6 rate(const Pose& a, const Pose& b) {
    return logarithm(a.T_world_video.inverse() * b.T_world_video) / secondsBetween(a.time, b.time);
}

bool near(const Pose& a, const Pose& b) {
    return b.time - a.time <= PoseHistory::kLongestGap;
}

}  // namespace

const Pose& PoseHistory::pose(std::size_t i) const {
    return ring_[(first_ + i) % kLength];
}

void PoseHistory::add(const Pose& added) {
    const auto follows = [&](const Pose& last) {
        return last.time < added.time && last.world == added.world;
    };
    if (count_ > 0 && !follows(pose(count_ - 1))) count_ = 0;
    if (count_ == kLength) {
        first_ = (first_ + 1) % kLength;
        --count_;
    }
    ring_[(first_ + count_) % kLength] = added;
    ++count_;
}

std::optional<Pose> PoseHistory::at(Timestamp t) const {
    std::size_t next = 1;
    while (next < count_ && pose(next).time < t)
        ++next;
    if (next >= count_ || t < pose(next - 1).time) return std::nullopt;
    const Pose &a = pose(next - 1), &b = pose(next);
    const bool before = next >= 2 && near(pose(next - 2), a);
    const bool after = next + 1 < count_ && near(b, pose(next + 1));
    if (!near(a, b) || !(before || after)) return std::nullopt;

    const double span = secondsBetween(a.time, b.time);
    const double s = secondsBetween(a.time, t) / span;
    const Vector6 twist = rate(a, b);
    const Vector6 change = (before ? rate(pose(next - 2), a) : rate(b, pose(next + 1))) - twist;
    // If the velocity changes by `change` within `span`, the path is a parabola. `arc` is the
    // distance of the parabola from its chord.
    const Vector6 arc = s * (1 - s) / 2 * span * change;
    Pose out;
    out.time = t;
    out.world = a.world;
    out.T_world_video = a.T_world_video * exponential(s * span * twist);
    // The errors of neighbouring poses are strongly correlated. So the mean of two poses is not
    // more precise than each of them.
    out.covariance = (1 - s) * a.covariance + s * b.covariance + arc * arc.transpose();
    return out;
}

}  // namespace mfar
