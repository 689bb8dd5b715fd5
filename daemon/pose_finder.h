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

/// What a picture source knows about poses.
struct PoseInputs {
    std::string source;  ///< name of the source, for messages
    StereoRig rig;
    double rateHz = 0;  ///< frame rate of the video
    TagMap tags;        ///< the tags in the scene; empty: unknown
    /// Returns the recorded pose at a point in time. The function is not set if there are no
    /// recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recorded;
};

/// The pose of the video camera at a still's time, measured from tags in the still.
struct StillMeasurement {
    std::optional<Pose> pose{};
    std::optional<double> ms{};  ///< duration of the search for tags [ms], if there was one
};

/// Finds the pose of the video camera at the times of frames and stills, from the configured source
/// of poses. Only one thread, not the GL thread, may call its functions, unless their comments
/// state otherwise.
class PoseFinder {
public:
    /// `stats` must outlive this object. Throws Failure if the configured source of poses is not
    /// available.
    PoseFinder(const PoseConfig& config, PoseInputs inputs, Stats& stats);

    /// Returns the pose of a frame, or nothing if it is unknown. Frames must come in the order of
    /// their times.
    [[nodiscard]] std::optional<Pose> ofVideo(const Frame& video);
    /// Searches tags in a still. Because this takes long, another thread than that of the other
    /// functions may call it.
    [[nodiscard]] StillMeasurement measure(const Frame& still);
    /// Returns the pose of a still that is not later than the last frame. If no pose was measured
    /// from the still's own tags, interpolates between the poses of frames, if PoseHistory can.
    [[nodiscard]] std::optional<Pose> place(const StillMeasurement& measured, Timestamp time);

    /// Returns whether a pose was measured or recorded, not only predicted.
    [[nodiscard]] bool isMeasured(const Pose& pose) const { return recorded_ || pose.tags > 0; }
    /// Returns the tag map that is known at the start. If none is known, the map is empty.
    [[nodiscard]] const TagMap& tags() const { return tags_; }
    /// Returns the tag map that was made from the first picture: the tag that defines the world
    /// frame. Returns it only once, and only if there was no tag map at the start. Thread-safe.
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
