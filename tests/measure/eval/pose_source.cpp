#include "tests/measure/eval/pose_source.h"

#include "hal/virtual/image_files.h"
#include "pipeline/track/tracker.h"

namespace mfar::eval {
namespace {

using ByTime = std::map<std::int64_t, Pose>;

std::optional<Pose> poseOf(const ByTime& poses, Timestamp time) {
    const auto found = poses.find(time.ns);
    return found == poses.end() ? std::nullopt : std::optional(found->second);
}

void put(ByTime& poses, const std::optional<Pose>& pose) {
    if (pose) poses.emplace(pose->time.ns, *pose);
}

}  // namespace

KnownPoses::KnownPoses(const Recording& recording, PoseSource source)
    : recording_(recording), source_(source) {
    if (source == PoseSource::Tags) track();
}

void KnownPoses::track() {
    TrackerOptions options;
    options.map = loadTagMap(recording_.root / "tags.toml");
    Tracker tracker(recording_.rig, options);
    auto still = recording_.stills.begin();
    for (const RecordedImage& image : recording_.video) {
        put(video_, tracker.track(loadImage(image.file).view(), image.time));
        // A still's pose has two planar solutions. The tracker chooses one by the camera's motion
        // in the video, so frames up to the still's time are processed first.
        for (; still != recording_.stills.end() && still->time <= image.time; ++still)
            put(still_, tracker.trackStill(loadImage(still->file).view(), still->time));
    }
    for (; still != recording_.stills.end(); ++still)
        put(still_, tracker.trackStill(loadImage(still->file).view(), still->time));
}

PosePair KnownPoses::of(Timestamp frame, Timestamp still) const {
    if (source_ == PoseSource::Recorded) return posesOf(recording_, frame, still);
    PosePair out{poseOf(video_, frame), poseOf(still_, still)};
    if (!out.still) out.still = poseOf(video_, still);
    return out;
}

}  // namespace mfar::eval
