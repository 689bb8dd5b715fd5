#include "daemon/tools/calibrate/pose_track.h"

#include "base/se3.h"

#include <algorithm>

namespace mfar::calibration {

RigidTransform between(const std::array<RigidTransform, 4>& poses,
                       const std::array<double, 4>& times, double t) {
    Vector6 motion = Vector6::Zero();
    for (int j = 0; j < 4; ++j) {
        if (j == 1) continue;
        double weight = 1;
        for (int m = 0; m < 4; ++m)
            if (m != j) weight *= (t - times[m]) / (times[j] - times[m]);
        motion += weight * logarithm(poses[1].inverse() * poses[j]);
    }
    return poses[1] * exponential(motion);
}

void PoseTrack::add(Timestamp time, const RigidTransform& pose) {
    times_.push_back(time);
    poses_.push_back(pose);
}

void PoseTrack::allowMissingFrames() {
    maxGap_ = 2.5;
}

double PoseTrack::interval() const {
    std::vector<double> gaps;
    for (std::size_t i = 1; i < times_.size(); ++i)
        gaps.push_back(secondsBetween(times_[i - 1], times_[i]));
    if (gaps.empty()) return 0;
    const auto quarter = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 4);
    std::nth_element(gaps.begin(), quarter, gaps.end());
    return *quarter;
}

std::optional<std::array<int, 4>> PoseTrack::around(Timestamp t) const {
    const auto next = std::upper_bound(times_.begin(), times_.end(), t);
    const int second = static_cast<int>(next - times_.begin()) - 1;
    if (second < 1 || second + 2 >= size()) return std::nullopt;
    const double limit = maxGap_ * interval();
    for (int i = second - 1; i < second + 2; ++i)
        if (!(secondsBetween(times_[i], times_[i + 1]) <= limit)) return std::nullopt;
    return std::array<int, 4>{second - 1, second, second + 1, second + 2};
}

std::optional<RigidTransform> PoseTrack::at(Timestamp t) const {
    const auto nodes = around(t);
    if (!nodes) return std::nullopt;
    std::array<RigidTransform, 4> poses;
    std::array<double, 4> times{};
    for (int j = 0; j < 4; ++j) {
        poses[j] = poses_[(*nodes)[j]];
        times[j] = secondsBetween(t, times_[(*nodes)[j]]);
    }
    return between(poses, times, 0);
}

}  // namespace mfar::calibration
