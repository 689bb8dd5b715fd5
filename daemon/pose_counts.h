#pragma once

#include "base/geometry.h"
#include "daemon/histogram.h"
#include "pipeline/track/tracker.h"

#include <cstdint>
#include <optional>

namespace mfar {

/// Counters of poses since the start, and the pose of the latest frame.
struct PoseCounts {
    std::uint64_t frames = 0;    ///< video frames for which a pose was requested
    std::uint64_t tracked = 0;   ///< frames that have a pose
    std::uint64_t measured = 0;  ///< frames with a pose from tags in the frame itself
    std::uint64_t stills = 0;
    std::uint64_t stillsTracked = 0;
    std::uint64_t stillsMeasured = 0;
    double tagSum = 0;    ///< sum of the numbers of tags in the measured frames
    double errorSum = 0;  ///< sum of the reprojection errors in the measured frames [px]
    /// Durations of the search for tags and of the computation of the pose [ms]: `ms` for video
    /// frames, `stillMs` for stills.
    Histogram ms;
    Histogram stillMs;
    TrackStats tracker;  ///< all 0 if poses do not come from tags
    std::optional<Pose> last{};

    void addFrame(const std::optional<Pose>& pose, const std::optional<TrackStats>& stats);
    void addStill(const std::optional<Pose>& pose, const std::optional<double>& tookMs);

    /// trackedShare() returns the share of `frames` that have a pose, [0, 1]. meanTags() and
    /// meanErrorPx() return means over the measured frames. Each function returns 0 without such
    /// frames.
    [[nodiscard]] double trackedShare() const;
    [[nodiscard]] double meanTags() const;
    [[nodiscard]] double meanErrorPx() const;
};

}  // namespace mfar
