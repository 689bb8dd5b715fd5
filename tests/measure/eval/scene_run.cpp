#include "tests/measure/eval/scene_run.h"

#include <opencv2/imgproc.hpp>

#include <stdexcept>
#include <utility>

namespace mfar::eval {
namespace {

using namespace std::chrono_literals;

std::unique_ptr<SyntheticBoard> startedBoard(SyntheticOptions options) {
    options.pace = Pace::Consumer;
    auto out = std::make_unique<SyntheticBoard>(options);
    out->video().start();
    out->stills().start();
    return out;
}

}  // namespace

TagMap tagMapOf(const synthetic::World& world) {
    std::vector<MappedTag> out;
    for (const synthetic::Tag& tag : world.tags)
        if (!tag.moves) out.push_back({{TagFamily::Tag36h11, tag.id}, tag.size, tag.T_world_tag});
    return TagMap(out);
}

SceneRun::SceneRun(SyntheticOptions options, PoseSource poses)
    : poses_(poses), board_(startedBoard(std::move(options))) {
    if (poses != PoseSource::Tags) return;
    TrackerOptions tracking;
    tracking.map = tagMapOf(board_->world());
    tracker_.emplace(board_->rig(), std::move(tracking));
}

SceneRun::Shots SceneRun::next() {
    auto frame = board_->video().next(60s);
    if (!frame) throw std::runtime_error("the synthetic board gave no frame");
    auto pose = poseOf(*frame);
    auto still = board_->stills().next(0s);
    auto stillPose = still ? poseOfStill(*still) : std::nullopt;
    return {std::move(*frame), std::move(pose), std::move(still), std::move(stillPose)};
}

std::optional<Pose> SceneRun::poseOf(const Frame& frame) {
    if (tracker_) return tracker_->track(frame.view(), frame.time());
    if (poses_ == PoseSource::Recorded) return board_->pose(frame.time());
    return std::nullopt;
}

std::optional<Pose> SceneRun::poseOfStill(const Frame& still) {
    if (tracker_) return tracker_->trackStill(still.view(), still.time());
    if (poses_ == PoseSource::Recorded) return board_->pose(still.time());
    return std::nullopt;
}

const FrameResult& runOn(Pipeline& pipeline, const SceneRun::Shots& shots) {
    if (shots.still) pipeline.setStill(shots.still->view(), shots.still->time(), shots.stillPose);
    return pipeline.run(shots.frame.view(), shots.frame.time(), shots.pose);
}

cv::Mat shownObjects(const Pipeline& pipeline) {
    const Size size = pipeline.outputSize();
    std::vector<float> values = pipeline.readShownObjects();
    if (values.empty()) return {size.height, size.width, CV_32F, cv::Scalar(0)};
    return cv::Mat(size.height, size.width, CV_32F, values.data()).clone();
}

cv::Mat shownAtVideo(const cv::Mat& shown, Size video) {
    cv::Mat small;
    cv::resize(shown, small, {video.width, video.height}, 0, 0, cv::INTER_AREA);
    return small >= 0.5;
}

}  // namespace mfar::eval
