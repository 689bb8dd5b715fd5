#include "tests/measure/bench/pipeline_run.h"

#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/pipeline_shot.h"
#include "tests/measure/eval/stopwatch.h"

#include <chrono>

namespace mfar::bench {
namespace {

std::optional<Pose> poseOf(const std::vector<std::optional<Pose>>& poses, std::size_t i) {
    return poses.empty() ? std::nullopt : poses[i];
}

PipelineOptions optionsFor(SuperResMode mode, EngineKind engine, int threads, Size output) {
    PipelineOptions options;
    options.mode = mode;
    options.output = output;
    options.engines = EngineChoice::all(engine);
    options.threads = threads;
    return options;
}

}  // namespace

void show(const Lesson& lesson, Timestamp time, Pipeline& pipeline) {
    eval::PipelineShot({lesson.still, time, lesson.stillPose}).giveAsStill(pipeline);
    eval::PipelineShot({lesson.frame, time, lesson.framePose}).run(pipeline);
}

PipelineRun::PipelineRun(const Workload& work, SuperResMode mode, EngineKind engine, int threads,
                         Size output)
    : work_(work), engine_(engine), pipeline_(work.rig, optionsFor(mode, engine, threads, output)) {
    pipeline_.setFilters(work.filters);
    for (const cv::Mat& still : work.stills)
        stills_.push_back(eval::toRgba(still));
    for (const cv::Mat& frame : work.frames)
        frames_.push_back(eval::toRgba(frame));
    if (work.before) show(*work.before, nextTime(), pipeline_);
}

double PipelineRun::run(std::size_t i) {
    if (still_ != work_.stillOf[i]) setStill(work_.stillOf[i]);
    return eval::wallMs([&] {
        stats_ =
            pipeline_.run(eval::viewOf(frames_[i]), nextTime(), poseOf(work_.framePoses, i)).stats;
        pipeline_.finish(engine_);
    });
}

double PipelineRun::setStill(std::size_t index) {
    still_ = index;
    pipeline_.finish(engine_);
    return eval::wallMs([&] {
        pipeline_.setStill(eval::viewOf(stills_[index]), nextTime(),
                           poseOf(work_.stillPoses, index));
        pipeline_.finish(engine_);
    });
}

Timestamp PipelineRun::nextTime() {
    time_ = time_ + std::chrono::nanoseconds{33'333'333};
    return time_;
}

}  // namespace mfar::bench
