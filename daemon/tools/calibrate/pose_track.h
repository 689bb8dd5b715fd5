#pragma once

#include "base/geometry.h"
#include "base/time.h"

#include <array>
#include <optional>
#include <vector>

namespace mfar::calibration {

/// Cubic interpolation of the pose at time t [s] from four poses at `times` [s]. At 30 Hz its error
/// for a hand's motion is 0.002 degrees; linear interpolation would be off by 0.02 degrees, a pixel
/// of the still.
[[nodiscard]] RigidTransform between(const std::array<RigidTransform, 4>& poses,
                                     const std::array<double, 4>& times, double t);

/// Poses of one target in the frames of a video, T_video_target.
class PoseTrack {
public:
    /// Times must rise; the caller leaves out frames without a pose.
    void add(Timestamp time, const RigidTransform& pose);
    [[nodiscard]] int size() const { return static_cast<int>(times_.size()); }

    /// Indices of four consecutive poses with t in the middle; nothing where one is missing.
    [[nodiscard]] std::optional<std::array<int, 4>> around(Timestamp t) const;
    [[nodiscard]] Timestamp time(int index) const { return times_[index]; }
    [[nodiscard]] const RigidTransform& pose(int index) const { return poses_[index]; }
    [[nodiscard]] std::optional<RigidTransform> at(Timestamp t) const;
    /// Median time between consecutive poses [s], 0 for fewer than two poses.
    [[nodiscard]] double interval() const;

private:
    std::vector<Timestamp> times_;
    std::vector<RigidTransform> poses_;
};

}  // namespace mfar::calibration
