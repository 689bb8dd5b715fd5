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

/// Pose information of a picture source.
struct PoseInputs {
    std::string source;  ///< its name, for messages
    StereoRig rig;
    double rateHz = 0;  ///< of the video
    TagMap tags;        ///< empty: unknown
    /// The pose at a time; empty without recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recorded;
};

/// The video camera's pose measured from a still itself, at the still's time.
struct StillMeasurement {
    std::optional<Pose> pose{};
    std::optional<double> ms{};  ///< time of the tag search, if there was one
};

/// Finds the video camera's pose for frames and stills at their times, from the configured origin.
/// Used by one thread, not the GL thread, unless stated otherwise.
class PoseFinder {
public:
    /// `stats` must outlive this. Throws Failure when the configured origin is not available.
    PoseFinder(const PoseConfig& config, PoseInputs inputs, Stats& stats);

    /// Frames must come in the order of their times. Nothing when the pose is unknown.
    [[nodiscard]] std::optional<Pose> ofVideo(const Frame& video);
    /// Searches tags in a still, which takes long. Called by one thread, which need not be the one
    /// of the other functions.
    [[nodiscard]] StillMeasurement measure(const Frame& still);
    /// The pose of a still that is not younger than the last frame. Without usable tags of its own
    /// it is interpolated between the frames around it, where PoseHistory can.
    [[nodiscard]] std::optional<Pose> place(const StillMeasurement& measured, Timestamp time);

    /// False for a pose that is only predicted.
    [[nodiscard]] bool isMeasured(const Pose& pose) const { return recorded_ || pose.tags > 0; }
    /// The tag map known at the start; empty: unknown.
    [[nodiscard]] const TagMap& tags() const { return tags_; }
    /// Without a tag map at the start: the map with the tag that has become the world frame,
    /// returned once. Any thread.
    [[nodiscard]] std::optional<TagMap> takeFoundTags() { return found_.tryTake(); }
    /// True while takeFoundTags() may still return a map.
    [[nodiscard]] bool mayFindTags() const { return tracker_ && tags_.empty(); }
    /// "poses from 12 tags"
    [[nodiscard]] const std::string& description() const { return description_; }

private:
    Stats& stats_;
    TagMap tags_;
    std::string description_;
    std::function<std::optional<Pose>(Timestamp)> recorded_;
    std::optional<Tracker> tracker_;
    bool foundTags_ = false;
    Mailbox<TagMap> found_{HandOver::NewestWins};
    PoseHistory history_;  ///< poses of frames with tags of their own
};

}  // namespace mfar
