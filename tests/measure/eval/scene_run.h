#pragma once

#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"
#include "pipeline/track/tracker.h"
#include "tests/measure/eval/pose_source.h"

#include <opencv2/core.hpp>

#include <memory>
#include <optional>

namespace mfar::eval {

/// The tags of a world that do not move.
[[nodiscard]] TagMap tagMapOf(const synthetic::World& world);

/// A synthetic scene as the product sees it, frame by frame: the pictures of both sensors, with
/// poses from one source. The board knows the truth. Equal options give equal pictures.
class SceneRun {
public:
    /// The board runs at the pace of its consumer. The program must be linked with
    /// createGlContext().
    SceneRun(SyntheticOptions options, PoseSource poses);

    /// The next frame with its pose, and the still that came before it, if any. The pose of a still
    /// is computed from the still itself. A still arrives some frames after its pulse.
    struct Shots {
        Frame frame;
        std::optional<Pose> pose;
        std::optional<Frame> still;
        std::optional<Pose> stillPose;
    };
    /// Throws std::runtime_error after the last frame.
    [[nodiscard]] Shots next();
    /// Fires the trigger, which requests a still.
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

/// Passes one frame to the pipeline; before it the still, if there is one.
const FrameResult& runOn(Pipeline& pipeline, const SceneRun::Shots& shots);

/// Share of each pixel of a pipeline's picture that shows a virtual object, CV_32F of the output's
/// size; 0 everywhere without objects.
[[nodiscard]] cv::Mat shownObjects(const Pipeline& pipeline);
/// Reduces `shown`, a result of shownObjects(), to the video's size: CV_8U, 255 where at least half
/// of a video pixel shows an object, else 0.
[[nodiscard]] cv::Mat shownAtVideo(const cv::Mat& shown, Size video);

}  // namespace mfar::eval
