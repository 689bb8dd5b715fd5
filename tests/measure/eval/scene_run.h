#pragma once

#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"
#include "pipeline/track/tracker.h"
#include "tests/measure/eval/pose_source.h"

#include <opencv2/core.hpp>

#include <memory>
#include <optional>

namespace mfar::eval {

[[nodiscard]] TagMap tagMapOf(const synthetic::World& world);

/// Frames and stills of a synthetic scene, with poses from one source. Equal options give equal
/// pictures.
class SceneRun {
public:
    /// The board runs at the pace of its consumer. The program must be linked with a library that
    /// defines createGlContext().
    SceneRun(SyntheticOptions options, PoseSource poses);

    /// The next frame, and the still that arrived before it, if any. A still arrives some frames
    /// after its trigger pulse. With PoseSource::Tags, a still's pose is found from the tags in the
    /// still.
    struct Shots {
        Frame frame;
        std::optional<Pose> pose;
        std::optional<Frame> still;
        std::optional<Pose> stillPose;
    };
    /// Throws std::runtime_error after the last frame.
    [[nodiscard]] Shots next();
    void fire() { board_->trigger().fire(); }

    [[nodiscard]] SyntheticBoard& board() const { return *board_; }
    [[nodiscard]] const StereoRig& rig() const { return board_->rig(); }

private:
    [[nodiscard]] std::optional<Pose> poseOf(const Frame& frame);
    [[nodiscard]] std::optional<Pose> poseOfStill(const Frame& still);

    PoseSource poses_;
    std::unique_ptr<SyntheticBoard> board_;
    std::optional<Tracker> tracker_;
};

const FrameResult& runOn(Pipeline& pipeline, const SceneRun::Shots& shots);

/// Returns for each output pixel the share of its area that shows a virtual object, CV_32F in
/// [0, 1].
[[nodiscard]] cv::Mat shownObjects(const Pipeline& pipeline);
/// Reduces the result of shownObjects() to the video's size: CV_8U, 255 where at least half of a
/// video pixel shows an object, else 0.
[[nodiscard]] cv::Mat shownAtVideo(const cv::Mat& shown, Size video);

}  // namespace mfar::eval
