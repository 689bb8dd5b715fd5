#pragma once

#include "base/geometry.h"

#include <array>
#include <cstddef>
#include <optional>

namespace mfar {

/// The poses of the last video frames, to interpolate between two of them. A still arrives tens of
/// milliseconds after its exposure, when the frames on both sides of it are known; a pose
/// interpolated between them is far more precise than a prediction. One thread.
class PoseHistory {
public:
    /// Times must rise; a step back clears the history.
    void add(const Pose& pose);

    /// The pose at t, at a constant rate of motion between its neighbours. The difference between
    /// that rate and the rate before or after is added to the covariance, as nothing better is
    /// known about the motion in between. tags = 0. Nothing when t is not between two poses at most
    /// kLongestGap apart, or when there is no third pose to estimate the change of rate from.
    [[nodiscard]] std::optional<Pose> at(Timestamp t) const;

    static constexpr std::chrono::milliseconds kLongestGap{100};
    static constexpr std::size_t kLength = 32;  ///< one second of video

private:
    [[nodiscard]] const Pose& pose(std::size_t i) const;  ///< 0 = oldest

    std::array<Pose, kLength> ring_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
};

}  // namespace mfar
