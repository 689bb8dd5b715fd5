#pragma once

#include "base/geometry.h"
#include "base/time.h"

#include <array>
#include <optional>
#include <vector>

namespace mfar::calibration {

/// The pose between four others at times [s], at time t [s]: the cubic through their motions. At
/// 30 Hz a hand's motion is between frames what this says to 0.002 degrees; a straight line would
/// be 0.02 degrees off, a pixel of the still.
[[nodiscard]] RigidTransform between(const std::array<RigidTransform, 4>& poses,
                                     const std::array<double, 4>& times, double t);

/// Poses of one target in the frames of a video, T_video_target.
class PoseTrack {
public:
    /// Times rise; frames without a pose are left out by the caller.
    void add(Timestamp time, const RigidTransform& pose);
    [[nodiscard]] int size() const { return static_cast<int>(times_.size()); }

    /// Indices of four poses in a row with t in the middle; nothing where one is missing.
    [[nodiscard]] std::optional<std::array<int, 4>> around(Timestamp t) const;
    [[nodiscard]] Timestamp time(int index) const { return times_[index]; }
    [[nodiscard]] const RigidTransform& pose(int index) const { return poses_[index]; }
    [[nodiscard]] std::optional<RigidTransform> at(Timestamp t) const;
    /// Median time between two poses [s], 0 for less than two.
    [[nodiscard]] double interval() const;

private:
    std::vector<Timestamp> times_;
    std::vector<RigidTransform> poses_;
};

}  // namespace mfar::calibration
