#pragma once

#include "pipeline/pipeline.h"
#include "tests/measure/bench/workload.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mfar::bench {

/// Gives the still and then the frame to the pipeline.
void show(const Lesson& lesson, Timestamp time, Pipeline& pipeline);

/// Runs mfar's pipeline on the frames of a workload. Setting a still is not part of a frame's time.
/// First, the older still is set and a frame is matched with it.
class PipelineRun {
public:
    /// `work` must outlive this object. `threads` and `output`: see PipelineOptions.
    PipelineRun(const Workload& work, SuperResMode mode, EngineKind engine, int threads = 0,
                Size output = {});

    /// Returns the time from upload to finished picture [ms].
    double run(std::size_t i);
    double setStill(std::size_t index);
    [[nodiscard]] Pipeline& pipeline() { return pipeline_; }
    [[nodiscard]] EngineKind engine() const { return engine_; }
    [[nodiscard]] const FrameStats& stats() const { return stats_; }

private:
    Timestamp nextTime();

    const Workload& work_;
    EngineKind engine_;
    Pipeline pipeline_;
    std::vector<cv::Mat> stills_, frames_;
    std::optional<std::size_t> still_;
    Timestamp time_;
    FrameStats stats_;
};

}  // namespace mfar::bench
