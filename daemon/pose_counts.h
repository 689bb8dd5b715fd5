#pragma once

#include "base/geometry.h"
#include "daemon/histogram.h"
#include "pipeline/track/tracker.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Counters of poses since the start, and the pose of the latest frame.
struct PoseCounts {
    std::uint64_t frames = 0;    ///< video frames for which a pose was searched
    std::uint64_t tracked = 0;   ///< number of `frames` that have a pose
    std::uint64_t measured = 0;  ///< number of `frames` with a pose from tags in the frame itself
    std::uint64_t stills = 0;
    std::uint64_t stillsTracked = 0;
    std::uint64_t stillsMeasured = 0;
    double tagSum = 0;           ///< sum over the measured frames of the number of tags
    double errorSum = 0;         ///< sum over the measured frames of the reprojection error [px]
    Histogram ms;                ///< times for finding tags and pose of a video frame [ms]
    Histogram stillMs;           ///< times for finding tags and pose of a still [ms]
    TrackStats tracker;          ///< zero if poses do not come from tags
    std::optional<Pose> last{};  ///< pose of the latest frame

    /// Counts a frame and its pose. `stats`: the tracker's statistics after this frame, if there is
    /// a tracker.
    void addFrame(const std::optional<Pose>& pose, const std::optional<TrackStats>& stats);
    /// Counts a still and its pose. `tookMs`: time of the search for tags in the still [ms], if
    /// there was one.
    void addStill(const std::optional<Pose>& pose, const std::optional<double>& tookMs);

    /// The following functions return the share of `frames` that have a pose, [0, 1], and two means
    /// over the measured frames. They return 0 if there are no such frames.
    [[nodiscard]] double trackedShare() const;
    [[nodiscard]] double meanTags() const;
    [[nodiscard]] double meanErrorPx() const;
};

}  // namespace mfar
