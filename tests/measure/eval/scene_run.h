#pragma once

#include "hal/virtual/synthetic_board.h"
#include "pipeline/pipeline.h"
#include "pipeline/track/tracker.h"
#include "tests/measure/eval/pose_source.h"

#include <opencv2/core.hpp>

#include <memory>
#include <optional>

namespace mfar::eval {

/// The tags of a world that stay where they are.
[[nodiscard]] TagMap tagMapOf(const synthetic::World& world);

/// A synthetic scene as the product meets it, frame by frame: the pictures of both sensors, with
/// the poses that a source tells. Its truth is the board's. Same options: the same pictures.
class SceneRun {
public:
    /// The board runs at its consumer's pace. Needs a linked createGlContext().
    SceneRun(SyntheticOptions options, PoseSource poses);

    /// The next frame and its pose; the pose of a still is what that shows itself. A still comes
    /// some frames after its pulse.
    struct Shots {
        Frame frame;
        std::optional<Pose> pose;
        std::optional<Frame> still;
        std::optional<Pose> stillPose;
    };
    /// Throws std::runtime_error when there are no more.
    [[nodiscard]] Shots next();
    /// Asks for a still.
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

/// One frame through the pipeline, after its still if there is one.
const FrameResult& runOn(Pipeline& pipeline, const SceneRun::Shots& shots);

/// How much of each pixel of a pipeline's picture shows a virtual object, CV_32F of the output's
/// size; nothing of any without objects.
[[nodiscard]] cv::Mat shownObjects(const Pipeline& pipeline);
/// The same at the video's size, where it is a half at least: CV_8U, 255 or 0.
[[nodiscard]] cv::Mat shownAtVideo(const cv::Mat& shown, Size video);

}  // namespace mfar::eval
