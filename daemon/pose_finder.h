#pragma once

#include "base/geometry.h"
#include "daemon/mailbox.h"
#include "daemon/pose_config.h"
#include "daemon/pose_history.h"
#include "daemon/stats.h"
#include "hal/frame.h"

#include <functional>
#include <optional>
#include <string>

namespace mfar {

/// Facts about poses that a picture source provides.
struct PoseInputs {
    std::string source;  ///< name of the source, for messages
    StereoRig rig;
    double rateHz = 0;  ///< frame rate of the video
    TagMap tags;        ///< empty: unknown
    /// Returns the recorded pose at a time. The function is not set if there are no recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recorded;
};

/// The pose of the video camera at a still's time, measured from tags in the still.
struct StillMeasurement {
    std::optional<Pose> pose{};
    std::optional<double> ms{};  ///< time of the search for tags [ms], if there was one
};

/// Finds the pose of the video camera at the times of frames and stills, from the configured
/// origin. Only one thread may use it, unless stated otherwise. This is not the GL thread.
class PoseFinder {
public:
    /// `stats` must outlive this object. Throws Failure if the configured origin is not available.
    PoseFinder(const PoseConfig& config, PoseInputs inputs, Stats& stats);

    /// Returns the pose of a frame, or nothing if it is unknown. Frames must come in the order of
    /// their times.
    [[nodiscard]] std::optional<Pose> ofVideo(const Frame& video);
    /// Searches tags in a still. This takes long, so another thread than that of the other
    /// functions may call it.
    [[nodiscard]] StillMeasurement measure(const Frame& still);
    /// Returns the pose of a still that is not later than the last frame. If none was measured from
    /// the still's own tags, the pose is interpolated between frames, if PoseHistory can do that.
    [[nodiscard]] std::optional<Pose> place(const StillMeasurement& measured, Timestamp time);

    /// Returns whether a pose was measured or recorded, not only predicted.
    [[nodiscard]] bool isMeasured(const Pose& pose) const { return recorded_ || pose.tags > 0; }
    /// Returns the tag map that is known at the start. If none is known, the map is empty.
    [[nodiscard]] const TagMap& tags() const { return tags_; }
    /// If there was no tag map at the start: returns, once, the map with the tag that defines the
    /// world frame. Thread-safe.
    [[nodiscard]] std::optional<TagMap> takeFoundTags() { return found_.tryTake(); }
    /// Returns whether there was no tag map at the start, so that takeFoundTags() may return one.
    [[nodiscard]] bool mayFindTags() const { return tracker_ && tags_.empty(); }
    /// Returns a description, such as "poses from 12 tags".
    [[nodiscard]] const std::string& description() const { return description_; }

private:
    Stats& stats_;
    TagMap tags_;
    std::string description_;
    std::function<std::optional<Pose>(Timestamp)> recorded_;
    std::optional<Tracker> tracker_;
    bool foundTags_ = false;
    Mailbox<TagMap> found_{HandOver::NewestWins};
    PoseHistory history_;  ///< poses that were measured from tags in the frames themselves
};

}  // namespace mfar
