#include "hal/virtual/synthetic_board.h"
#include "tests/measure/bench/bench.h"
#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/bench/pareto_timing.h"
#include "tests/measure/bench/pipeline_run.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/metrics/psnr.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/superres.h"
#include "tests/measure/eval/superres_samples.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgproc.hpp>

#include <chrono>
#include <functional>

namespace mfar::bench {
namespace {

constexpr std::size_t kScoredEvery = 3;

cv::Mat lumaOf(const StoredImage& picture, Size size) {
    const cv::Mat rgba(picture.size.height, picture.size.width, CV_8UC4,
                       const_cast<std::uint8_t*>(picture.pixels.data()));
    cv::Mat bgr;
    cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
    if (!(picture.size == size))
        cv::resize(bgr, bgr, {size.width, size.height}, 0, 0, cv::INTER_AREA);
    return eval::luma(bgr);
}

double errorOf(const cv::Mat& bgr, const cv::Mat& truth) {
    constexpr int kBorder = eval::kSuperResBorder;
    const cv::Rect inner(kBorder, kBorder, truth.cols - 2 * kBorder, truth.rows - 2 * kBorder);
    return std::sqrt(eval::meanSquaredError(eval::luma(bgr)(inner), truth(inner)));
}

struct SequenceWay {
    std::function<void()> begin;
    std::function<void(std::size_t)> run;
    /// Returns the result for frame i, CV_8UC3. The last call of `run` must have been run(i).
    std::function<cv::Mat(std::size_t)> picture;
};

void measureWay(const SequenceSample& sample, const SequenceWay& way, const ParetoRun& run,
                bool scored, WayTimes& out) {
    way.begin();
    for (std::size_t i = 0; i < sample.work.frames.size(); ++i) {
        const double ms = msOf(run.clock, [&] { way.run(i); });
        if (!scored && i > 0) out.time(ms);
        if (scored && !sample.truth[i].empty()) out.error(errorOf(way.picture(i), sample.truth[i]));
    }
}

class SequencePipeline {
public:
    explicit SequencePipeline(const Workload& work)
        : work_(work), pipeline_(work.rig, {.output = {}, .skipUnchanged = false}),
          still_(eval::toRgba(work.stills[0])) {
        pipeline_.setFilters(learnedFrom(work));
        for (const cv::Mat& frame : work.frames)
            frames_.push_back(eval::toRgba(frame));
    }

    [[nodiscard]] SequenceWay way(const Quality& quality) {
        return {[this, quality] {
                    pipeline_.setQuality(quality);
                    pipeline_.dropStill();
                    if (work_.before) show(*work_.before, {}, pipeline_);
                    pipeline_.setStill(eval::viewOf(still_), {}, work_.stillPoses[0]);
                },
                [this](std::size_t i) {
                    pipeline_.run(eval::viewOf(frames_[i]), work_.framePoses[i]->time,
                                  work_.framePoses[i]);
                    glFinish();
                },
                [this](std::size_t) {
                    return eval::fromRgba(pipeline_.readImage(), pipeline_.outputSize());
                }};
    }
    [[nodiscard]] Size output() const { return pipeline_.outputSize(); }

private:
    const Workload& work_;
    Pipeline pipeline_;
    cv::Mat still_;
    std::vector<cv::Mat> frames_;
};

SequenceWay bicubicWay(const Workload& work, Size output) {
    auto out = std::make_shared<cv::Mat>();
    return {[] {},
            [&work, out, output](std::size_t i) {
                cv::resize(work.frames[i], *out, {output.width, output.height}, 0, 0,
                           cv::INTER_CUBIC);
            },
            [out](std::size_t) { return *out; }};
}

SequenceWay paperWay(const Workload& work, Size output, eval::DisPreset preset) {
    auto paper =
        std::make_shared<eval::PaperPipeline>(work.rig, output, eval::PaperOptions{preset, 2});
    auto out = std::make_shared<cv::Mat>();
    return {[&work, paper] { paper->setStill(work.stills[0]); },
            [&work, paper, out](std::size_t i) { *out = paper->run(work.frames[i]); },
            [out](std::size_t) { return *out; }};
}

constexpr const char* kPictures[] = {"bicubic", "paper", "paper with DIS fast"};

void measureSequence(const SequenceSample& sample, const std::vector<QualitySetting>& settings,
                     const ParetoRun& run, std::vector<WayTimes>& times) {
    SequencePipeline ours(sample.work);
    std::vector<SequenceWay> ways;
    for (const QualitySetting& setting : settings)
        ways.push_back(ours.way(setting.quality));
    ways.push_back(bicubicWay(sample.work, ours.output()));
    ways.push_back(paperWay(sample.work, ours.output(), eval::DisPreset::Medium));
    ways.push_back(paperWay(sample.work, ours.output(), eval::DisPreset::Fast));
    for (int round = 0; round <= run.rounds; ++round) {
        run.showRound(round);
        for (std::size_t i = 0; i < ways.size(); ++i)
            measureWay(sample, ways[i], run, round == 0, times[i]);
    }
    for (WayTimes& way : times)
        way.endSample();
}

}  // namespace

std::vector<SequenceSample> syntheticSequences(Size video, Size still, int frames,
                                               std::size_t most) {
    std::vector<SequenceSample> out;
    for (const synthetic::Scene scene : {synthetic::Scene::Office, synthetic::Scene::Shelf}) {
        if (out.size() == most) break;
        SyntheticBoard board(handheldOptions(scene, video, still));
        SequenceSample sample{handheldWorkload(board, video, still, frames, kLessons), {}};
        sample.work.name = name(scene);
        for (std::size_t i = 0; i < sample.work.frames.size(); ++i)
            sample.truth.push_back(
                i % kScoredEvery + 1 == kScoredEvery
                    ? lumaOf(board.highRes(sample.work.framePoses[i]->time), still)
                    : cv::Mat());
        out.push_back(std::move(sample));
    }
    return out;
}

ParetoStage superResStage(const std::vector<SequenceSample>& samples, const ParetoRun& run) {
    const std::vector<QualitySetting> settings = qualitySettings();
    std::vector<WayTimes> times(settings.size() + std::size(kPictures));
    std::vector<std::string> names;
    for (const SequenceSample& sample : samples) {
        const ParetoRun one = run.part(names.size(), samples.size(), sample.work.name);
        names.push_back(sample.work.name);
        measureSequence(sample, settings, one, times);
    }
    if (samples.empty()) return {"super-resolution", "RMS error [grey levels]", "", {}};
    std::vector<std::string> ours;
    for (const QualitySetting& setting : settings)
        ours.push_back(setting.name);
    return {"super-resolution", "RMS error [grey levels]", fmt::format("{}", fmt::join(names, " ")),
            pointsOf(ours, {std::begin(kPictures), std::end(kPictures)}, times)};
}

}  // namespace mfar::bench
