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

/// What a source of pictures knows about poses.
struct PoseInputs {
    std::string source;  ///< its name, for messages
    StereoRig rig;
    double rateHz = 0;  ///< of the video
    TagMap tags;        ///< empty: unknown
    /// The pose at a time; empty where there are no recorded poses.
    std::function<std::optional<Pose>(Timestamp)> recorded;
};

/// What a still itself says about the video camera's pose at its time.
struct StillMeasurement {
    std::optional<Pose> pose{};
    std::optional<double> ms{};  ///< that the search for tags took, where there was one
};

/// Gives frames and stills the video camera's pose at their time, from where the configuration
/// says. Used by one thread, which is not the GL thread, where nothing else is said.
class PoseFinder {
public:
    /// `stats` must outlive this. Throws Failure when there is no such thing as configured.
    PoseFinder(const PoseConfig& config, PoseInputs inputs, Stats& stats);

    /// Frames in the order of their times. Nothing when the pose is not known.
    [[nodiscard]] std::optional<Pose> ofVideo(const Frame& video);
    /// Seeks tags in a still, which takes long. By one thread, which may be a further one.
    [[nodiscard]] StillMeasurement measure(const Frame& still);
    /// The pose of a still that is not younger than the last frame. One whose own tags cannot be
    /// used gets the pose between those of the frames around it, where PoseHistory has one.
    [[nodiscard]] std::optional<Pose> place(const StillMeasurement& measured, Timestamp time);

    /// Not only predicted.
    [[nodiscard]] bool isMeasured(const Pose& pose) const { return recorded_ || pose.tags > 0; }
    /// Where the tags are, as known at the start; empty: unknown.
    [[nodiscard]] const TagMap& tags() const { return tags_; }
    /// Without such a map: the one of the tag that has become the world, once. From any thread.
    [[nodiscard]] std::optional<TagMap> takeFoundTags() { return found_.tryTake(); }
    /// A map may still come that way.
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
    PoseHistory history_;  ///< of frames whose own tags were seen
};

}  // namespace mfar
