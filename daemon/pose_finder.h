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

struct PoseInputs {
    std::string source;
    StereoRig rig;
    double rateHz = 0;
    TagMap tags;  ///< the tags in the scene; empty: unknown
    /// Returns the recorded pose at a point in time. Not set if there are no recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recorded;
};

struct StillMeasurement {
    std::optional<Pose> pose{};
    std::optional<double> ms{};
};

/// Finds the pose of the video camera at the times of frames and stills. Functions that are not
/// const must be called by the same thread, unless a function's comment allows another one. That
/// thread need not be the picture thread.
class PoseFinder {
public:
    /// `stats` must outlive this object. Throws Failure if the configured source of poses is not
    /// available.
    PoseFinder(const PoseConfig& config, PoseInputs inputs, Stats& stats);

    /// Returns the pose of a frame, or nothing if it is unknown. Frames must come in the order of
    /// their times.
    [[nodiscard]] std::optional<Pose> ofVideo(const Frame& video);
    /// Searches a still for tags. This takes long, so a second thread may call this function while
    /// the first thread calls the others.
    [[nodiscard]] StillMeasurement measure(const Frame& still);
    /// Returns the video camera's pose at the time of a still. `time` must not be later than the
    /// last frame. If the still has no measured pose, PoseHistory interpolates between the poses of
    /// frames.
    [[nodiscard]] std::optional<Pose> place(const StillMeasurement& measured, Timestamp time);

    /// Returns true if the pose was recorded, or if it was measured in a world frame that will not
    /// change any more, see Tracker::map(). Returns false if the pose was only predicted. Only the
    /// thread that calls ofVideo() may call it.
    [[nodiscard]] bool isRecordable(const Pose& pose) const {
        return recorded_ || (pose.tags > 0 && (foundTags_ || !mayFindTags()));
    }
    [[nodiscard]] const TagMap& tags() const { return tags_; }
    /// If there was no tag map at the start, returns the map that was made from the first pictures
    /// with tags, see Tracker::map(). Its only tag defines the world frame. Returns the map only
    /// once. Thread-safe.
    [[nodiscard]] std::optional<TagMap> takeFoundTags() { return found_.tryTake(); }
    [[nodiscard]] bool mayFindTags() const { return tracker_ && tags_.empty(); }
    [[nodiscard]] const std::string& description() const { return description_; }

private:
    Stats& stats_;
    TagMap tags_;
    std::string description_;
    std::function<std::optional<Pose>(Timestamp)> recorded_;
    std::optional<Tracker> tracker_;
    bool foundTags_ = false;
    Mailbox<TagMap> found_{HandOver::NewestWins};
    PoseHistory history_;
};

}  // namespace mfar
