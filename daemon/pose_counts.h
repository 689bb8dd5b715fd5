#pragma once

#include "base/geometry.h"
#include "daemon/histogram.h"
#include "pipeline/track/tracker.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Counters of poses since the start, and the latest frame's pose. A copy, read without locks.
struct PoseCounts {
    std::uint64_t frames = 0;    ///< video frames for which a pose was searched
    std::uint64_t tracked = 0;   ///< of these: with a pose
    std::uint64_t measured = 0;  ///< of the tracked: measured from tags in the frame itself
    std::uint64_t stills = 0;
    std::uint64_t stillsTracked = 0;
    std::uint64_t stillsMeasured = 0;
    double tagSum = 0;           ///< sum of the number of tags over the measured frames
    double errorSum = 0;         ///< sum of the reprojection errors over the measured frames [px]
    Histogram ms;                ///< time for detector and pose of a video frame
    Histogram stillMs;           ///< time for detector and pose of a still
    TrackStats tracker;          ///< zero where poses do not come from tags
    std::optional<Pose> last{};  ///< of the latest frame

    /// `stats`: the tracker's after this frame, if there is a tracker.
    void addFrame(const std::optional<Pose>& pose, const std::optional<TrackStats>& stats);
    /// `tookMs`: time of the tag search, if there was one.
    void addStill(const std::optional<Pose>& pose, const std::optional<double>& tookMs);

    /// Shares of the frames, [0, 1], and means over the measured ones; 0 where there are none.
    [[nodiscard]] double trackedShare() const;
    [[nodiscard]] double meanTags() const;
    [[nodiscard]] double meanErrorPx() const;
};

}  // namespace mfar
