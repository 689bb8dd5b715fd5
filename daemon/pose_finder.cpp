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
    if (!map.empty()) return fmt::format("poses from {} tags", map.tags().size());
    return fmt::format("poses from the first tag, {:g} m", config.tagSize);
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
                          inputs.source + ": has no poses, and pose.source is \"recorded\"");
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
    if (pose && mayFindTags() && !std::exchange(foundTags_, true)) found_.put(tracker_->map());
    stats_.framePose(pose, tracker_->stats());
    return pose;
}

std::optional<Pose> PoseFinder::ofStill(const Frame& still) {
    if (recorded_) {
        std::optional<Pose> pose = recorded_(still.time());
        stats_.stillPose(pose, {});
        return pose;
    }
    if (!tracker_) return std::nullopt;
    const auto begin = std::chrono::steady_clock::now();
    std::optional<Pose> pose = tracker_->trackStill(still.view(), still.time());
    const std::chrono::duration<double, std::milli> span = std::chrono::steady_clock::now() - begin;
    if (!pose) pose = history_.at(still.time());
    stats_.stillPose(pose, span.count());
    return pose;
}

}  // namespace mfar
