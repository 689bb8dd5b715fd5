#pragma once

#include "base/geometry.h"

#include <array>
#include <cstddef>
#include <optional>

namespace mfar {

/// The poses of the last video frames, for what was exposed between two of them. A still arrives
/// tens of milliseconds after its exposure, when the frames on both sides of it are known, and
/// between them its pose is far surer than a prediction. One thread.
class PoseHistory {
public:
    /// Times must rise; a step back forgets what came before.
    void add(const Pose& pose);

    /// The pose at t, moving at a constant rate between its neighbours. How much that rate differs
    /// from that of the frames before or after is part of its covariance, as nothing better is
    /// known about what the camera did meanwhile. tags = 0. Nothing when t is not between two poses
    /// at most kLongestGap apart, or when no third pose tells how steady the motion is.
    [[nodiscard]] std::optional<Pose> at(Timestamp t) const;

    static constexpr std::chrono::milliseconds kLongestGap{100};
    static constexpr std::size_t kLength = 32;  ///< a second of video

private:
    [[nodiscard]] const Pose& pose(std::size_t i) const;  ///< 0 = oldest

    std::array<Pose, kLength> ring_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
};

}  // namespace mfar
