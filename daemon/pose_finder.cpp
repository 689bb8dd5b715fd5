#include "daemon/pose_finder.h"

#include "daemon/exit_code.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace mfar {
namespace {

std::string describe(const PoseConfig& config, const TagMap& map) {
    switch (config.source) {
    case PoseOrigin::None: return "no poses";
    case PoseOrigin::Recorded: return "recorded poses";
    case PoseOrigin::Tags: break;
    }
    if (const std::size_t tags = map.tags().size(); tags > 0)
        return fmt::format("poses from a map of {} tag{}", tags, tags == 1 ? "" : "s");
    return fmt::format("poses from the first tag, whose edge is {:g} m", config.tagSize);
}

}  // namespace

PoseFinder::PoseFinder(const PoseConfig& config, PoseInputs inputs, Stats& stats)
    : stats_(stats), tags_(config.tags.empty() ? std::move(inputs.tags) : configuredTags(config)),
      description_(describe(config, tags_)) {
    if (config.source == PoseOrigin::Tags)
        tracker_.emplace(inputs.rig, trackerOptions(config, tags_, inputs.rateHz));
    if (config.source == PoseOrigin::Recorded) {
        if (!inputs.recorded)
            throw Failure(ExitCode::BadData,
                          inputs.source + ": has no poses, but pose.source is \"recorded\"");
        recorded_ = std::move(inputs.recorded);
    }
}

std::optional<Pose> PoseFinder::ofVideo(const Frame& video) {
    if (recorded_) {
        std::optional<Pose> pose = recorded_(video.time());
        stats_.framePose(pose, {});
        return pose;
    }
    if (!tracker_) return std::nullopt;
    std::optional<Pose> pose = tracker_->track(video.view(), video.time());
    if (pose && pose->tags > 0) history_.add(*pose);
    if (pose && mayFindTags() && !foundTags_) {
        TagMap map = tracker_->map();
        foundTags_ = !map.empty();
        if (foundTags_) found_.put(std::move(map));
    }
    stats_.framePose(pose, tracker_->stats());
    return pose;
}

StillMeasurement PoseFinder::measure(const Frame& still) {
    if (recorded_) return {recorded_(still.time())};
    if (!tracker_) return {};
    const auto begin = std::chrono::steady_clock::now();
    StillMeasurement out{tracker_->trackStill(still.view(), still.time())};
    const std::chrono::duration<double, std::milli> span = std::chrono::steady_clock::now() - begin;
    out.ms = span.count();
    return out;
}

std::optional<Pose> PoseFinder::place(const StillMeasurement& measured, Timestamp time) {
    if (!recorded_ && !tracker_) return std::nullopt;
    std::optional<Pose> pose = measured.pose;
    if (!pose && tracker_) pose = history_.at(time);
    stats_.stillPose(pose, measured.ms);
    return pose;
}

}  // namespace mfar
