#pragma once

#include "base/geometry.h"

#include <array>
#include <cstddef>
#include <optional>

namespace mfar {

/// Keeps the poses of the last video frames and interpolates between them. A still arrives tens of
/// milliseconds after its exposure. By then, the poses of the frames before and after it are known.
/// An interpolated pose is far more precise than a predicted one. Only one thread may use it.
class PoseHistory {
public:
    /// Adds a pose. If its time is not later than that of the last pose, or if it is in another
    /// world frame, the history is cleared first.
    void add(const Pose& pose);

    /// Returns the pose at t. It is interpolated between the poses before and after t, at constant
    /// velocity. The error of this assumption is estimated and added to the covariance: the
    /// velocity between these two poses is compared with the velocity in the interval before or
    /// after them. Pose::tags is 0. Returns nothing if t is not between two poses at most
    /// kLongestGap apart, or if no third pose for the comparison is within kLongestGap of them.
    [[nodiscard]] std::optional<Pose> at(Timestamp t) const;

    static constexpr std::chrono::milliseconds kLongestGap{100};
    static constexpr std::size_t kLength = 256;  ///< two seconds of video at 120 Hz

private:
    [[nodiscard]] const Pose& pose(std::size_t i) const;  ///< i = 0: the oldest

    std::array<Pose, kLength> ring_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
};

}  // namespace mfar
