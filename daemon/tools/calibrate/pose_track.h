#pragma once

#include "base/geometry.h"
#include "base/time.h"

#include <array>
#include <optional>
#include <vector>

namespace mfar::calibration {

/// Interpolates a pose at time t [s] between four poses at `times` [s], with cubic polynomials. For
/// a camera in a moving hand and 30 poses per second, the error is 0.002 degrees. With linear
/// interpolation, it would be 0.02 degrees, about a pixel of the still.
[[nodiscard]] RigidTransform between(const std::array<RigidTransform, 4>& poses,
                                     const std::array<double, 4>& times, double t);

/// The poses T_video_target of one target in the frames of a video.
class PoseTrack {
public:
    /// Adds the pose of a frame. Times must increase. For a frame without a pose, nothing is added.
    void add(Timestamp time, const RigidTransform& pose);
    [[nodiscard]] int size() const { return static_cast<int>(times_.size()); }

    /// Returns the indices of four consecutive poses, two before and two after t. Returns nothing
    /// if there are no such poses, or if a frame between them is missing. After
    /// allowMissingFrames(), one missing frame between two neighbouring poses is accepted.
    [[nodiscard]] std::optional<std::array<int, 4>> around(Timestamp t) const;
    [[nodiscard]] Timestamp time(int index) const { return times_[index]; }
    [[nodiscard]] const RigidTransform& pose(int index) const { return poses_[index]; }
    [[nodiscard]] std::optional<RigidTransform> at(Timestamp t) const;
    /// Returns the time between consecutive frames [s]; 0 if there are fewer than two poses. It is
    /// the lower quartile of the gaps between poses, because many frames may be missing.
    [[nodiscard]] double interval() const;

    /// Lets around() and at() accept single missing frames. Poses interpolated across such a gap
    /// are less accurate. But otherwise, a recording that has lost many frames would have too few
    /// usable stills.
    void allowMissingFrames();

private:
    double maxGap_ = 1.5;  // [intervals]; one missing frame makes a gap of 2
    std::vector<Timestamp> times_;
    std::vector<RigidTransform> poses_;
};

}  // namespace mfar::calibration
