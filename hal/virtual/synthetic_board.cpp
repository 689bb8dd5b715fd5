#include "hal/virtual/synthetic_board.h"

#include "hal/virtual/synthetic_studio.h"
#include "hal/virtual/synthetic_truth.h"

#include <string>

namespace mfar {
namespace {

class VideoSensor final : public Camera {
public:
    VideoSensor(SyntheticStudio& studio, CameraInfo info)
        : studio_(studio), info_(std::move(info)) {}
    CameraInfo info() const override { return info_; }
    void start() override { studio_.startVideo(); }
    std::optional<Frame> next(std::chrono::milliseconds timeout) override {
        return studio_.nextVideo(timeout);
    }
    void stop() override { studio_.stopVideo(); }
    bool ended() const override { return studio_.videoEnded(); }

private:
    SyntheticStudio& studio_;
    CameraInfo info_;
};

class StillSensor final : public Camera {
public:
    StillSensor(SyntheticStudio& studio, CameraInfo info)
        : studio_(studio), info_(std::move(info)) {}
    CameraInfo info() const override { return info_; }
    void start() override { studio_.startStills(); }
    std::optional<Frame> next(std::chrono::milliseconds timeout) override {
        return studio_.nextStill(timeout);
    }
    void stop() override { studio_.stopStills(); }
    bool ended() const override { return studio_.stillsEnded(); }

private:
    SyntheticStudio& studio_;
    CameraInfo info_;
};

class PulseLine final : public Trigger {
public:
    explicit PulseLine(SyntheticStudio& studio) : studio_(studio) {}
    Timestamp fire() override { return studio_.fire(); }
    bool isStillComing() const override { return studio_.isStillComing(); }
    std::string name() const override { return "synthetic trigger"; }

private:
    SyntheticStudio& studio_;
};

SyntheticOptions withPath(SyntheticOptions options) {
    if (options.path) return options;
    switch (options.scene) {
    case synthetic::Scene::Still: options.path = synthetic::Path::Rest; break;
    case synthetic::Scene::Calibration: options.path = synthetic::Path::Survey; break;
    default: options.path = synthetic::Path::Handheld; break;
    }
    return options;
}

synthetic::Viewpoint viewpoint(const SyntheticStudio& studio, const StereoRig& rig,
                               SyntheticBoard::View view, Timestamp t) {
    const RigidTransform T_world_video = studio.pose(t).T_world_video;
    const double seconds = studio.worldTime(t);
    const RigidTransform T_video_still = rig.T_still_video.inverse();
    switch (view) {
    case SyntheticBoard::View::Still: return {rig.still, T_world_video * T_video_still, seconds};
    case SyntheticBoard::View::StillAtVideo:
        return {rig.video,
                T_world_video *
                    RigidTransform{Eigen::Quaterniond::Identity(), T_video_still.translation},
                seconds};
    case SyntheticBoard::View::Video: break;
    }
    return {rig.video, T_world_video, seconds};
}

}  // namespace

SyntheticBoard::SyntheticBoard(const SyntheticOptions& options)
    : rig_(options.rig.value_or(synthetic::boardRig())),
      world_(synthetic::makeWorld(options.scene, options.seed)),
      studio_(std::make_unique<SyntheticStudio>(withPath(options), world_, rig_)),
      video_(std::make_unique<VideoSensor>(*studio_,
                                           CameraInfo{"synthetic video sensor", rig_.video.size,
                                                      PixelFormat::Rgba8, options.rateHz})),
      stills_(std::make_unique<StillSensor>(
          *studio_, CameraInfo{"synthetic still sensor", rig_.still.size, PixelFormat::Rgba8, 0})),
      trigger_(std::make_unique<PulseLine>(*studio_)) {}

SyntheticBoard::~SyntheticBoard() = default;

Timestamp SyntheticBoard::epoch() const {
    return studio_->epoch();
}

Pose SyntheticBoard::pose(Timestamp t) const {
    return studio_->pose(t);
}

FloatImage SyntheticBoard::inverseDepth(Timestamp t) const {
    return synthetic::inverseDepth(world_, viewpoint(*studio_, rig_, View::Video, t));
}

FlowImage SyntheticBoard::flow(View from, Timestamp fromTime, View to, Timestamp toTime) const {
    return synthetic::flowBetween(world_, viewpoint(*studio_, rig_, from, fromTime),
                                  viewpoint(*studio_, rig_, to, toTime));
}

StoredImage SyntheticBoard::highRes(Timestamp t) {
    return studio_->highRes(t);
}

StoredImage SyntheticBoard::cleanVideo(Timestamp t) {
    return studio_->cleanVideo(t);
}

}  // namespace mfar
