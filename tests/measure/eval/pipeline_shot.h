#pragma once

#include "pipeline/pipeline.h"
#include "tests/measure/eval/shot.h"

namespace mfar::eval {

/// A shot in the pipeline's format. It is converted beforehand, so a timed run does not include the
/// conversion.
class PipelineShot {
public:
    /// `usePose` = false hides a known pose from the pipeline.
    explicit PipelineShot(const Shot& shot, bool usePose = true);

    void giveAsStill(Pipeline& pipeline) const;
    const FrameResult& run(Pipeline& pipeline) const;

private:
    cv::Mat rgba_;
    Timestamp time_;
    std::optional<Pose> pose_;
};

}  // namespace mfar::eval
