#pragma once

#include "base/geometry.h"
#include "daemon/histogram.h"
#include "pipeline/track/tracker.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// What is known about poses since the start, and about the latest frame's. A copy, free of locks.
struct PoseCounts {
    std::uint64_t frames = 0;    ///< video frames for which a pose was sought
    std::uint64_t tracked = 0;   ///< of these: with a pose
    std::uint64_t measured = 0;  ///< of these: from tags in the frame itself
    std::uint64_t stills = 0;
    std::uint64_t stillsTracked = 0;
    std::uint64_t stillsMeasured = 0;
    double tagSum = 0;           ///< tags over the measured frames
    double errorSum = 0;         ///< reprojection error over the measured frames [px]
    Histogram ms;                ///< detector and pose of a video frame
    Histogram stillMs;           ///< detector and pose of a still
    TrackStats tracker;          ///< zero where poses do not come from tags
    std::optional<Pose> last{};  ///< of the latest frame

    /// `stats`: of the tracker after this frame, where there is one.
    void addFrame(const std::optional<Pose>& pose, const std::optional<TrackStats>& stats);
    /// `tookMs`: to find tags, where they were sought.
    void addStill(const std::optional<Pose>& pose, const std::optional<double>& tookMs);

    /// Shares of the frames, [0, 1], and means over the measured ones; 0 where there are none.
    [[nodiscard]] double trackedShare() const;
    [[nodiscard]] double meanTags() const;
    [[nodiscard]] double meanErrorPx() const;
};

}  // namespace mfar
