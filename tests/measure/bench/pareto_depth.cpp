#include "hal/virtual/image_files.h"
#include "hal/virtual/synthetic_board.h"
#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/bench/pareto_timing.h"
#include "tests/measure/eval/depth_methods.h"
#include "tests/measure/eval/flow_samples.h"
#include "tests/measure/eval/labels.h"
#include "tests/measure/eval/metrics/depth_error.h"
#include "tests/measure/eval/picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <limits>

namespace mfar::bench {
namespace {

struct DepthSetting {
    const char* name;
    EpipolarOptions search;
};

std::vector<DepthSetting> depthSettings() {
    return {{"depth", {}},
            {"finest 1", {.finest = 1}},
            {"finest 1, windowRadius 1", {.windowRadius = 1, .finest = 1}},
            {"levels 3", {.levels = 3}},
            {"windowRadius 1", {.windowRadius = 1}},
            {"windowRadius 4", {.windowRadius = 4}},
            {"longestParallax 0.2", {.longestParallax = 0.2}},
            {"stepPenalty 8", {.stepPenalty = 8}},
            {"stepPenalty 20", {.stepPenalty = 20}},
            {"jumpPenalty 30", {.jumpPenalty = 30}}};
}

constexpr const char* kDepthPeers[] = {"midpoint", "sgbm", "stereobm"};

PipelineOptions depthOptions(const DepthSetting& setting, const StereoRig& rig) {
    PipelineOptions out;
    out.output = rig.video.size;
    out.skipUnchanged = false;
    out.epipolar = setting.search;
    out.depthEverywhere = true;
    return out;
}

double scoreOf(const DepthSample& sample, const cv::Mat& inverseDepth) {
    const CurveSample& shots = sample.shots;
    const double baseline =
        eval::stillFromFrame(shots.rig, *shots.frame.pose, *shots.still.pose).translation.norm();
    const cv::Mat all(inverseDepth.size(), CV_8U, cv::Scalar(255));
    return 100 *
           eval::depthError(inverseDepth, sample.inverseDepth, shots.rig.video.fx * baseline, all)
               .bad1;
}

/// Measures one setting on one sample. Only the first result is scored, because the filter mixes
/// later results with earlier ones.
class DepthWay {
public:
    DepthWay(const DepthSample& sample, const DepthSetting& setting)
        : sample_(sample), pipeline_(sample.shots.rig, depthOptions(setting, sample.shots.rig)),
          frame_(eval::toRgba(sample.shots.frame.picture)),
          still_(eval::toRgba(sample.shots.still.picture)) {
        pipeline_.setMeasure(true);
    }

    void measure(const ParetoRun& run, bool scored, WayTimes& out) {
        const CurveSample& shots = sample_.shots;
        // Depth is measured only once while the camera rests, but again after each new still.
        pipeline_.setStill(eval::viewOf(still_), shots.still.time, shots.still.pose);
        const double ms = msOf(run.clock, [&] {
            pipeline_.run(eval::viewOf(frame_), shots.frame.time, shots.frame.pose);
        });
        if (!scored) return out.time(ms * shareOfStages(pipeline_, eval::kDepthStages));
        const InverseDepthField& field = pipeline_.inverseDepth();
        cv::Mat inverseDepth(frame_.size(), CV_32F, cv::Scalar(0));
        for (std::size_t i = 0; i < field.inverseDepth.size(); ++i)
            if (field.isKnown(i)) inverseDepth.ptr<float>()[i] = field.inverseDepth[i];
        out.error(scoreOf(sample_, inverseDepth));
    }

private:
    const DepthSample& sample_;
    Pipeline pipeline_;
    cv::Mat frame_, still_;
};

void measurePeer(const DepthSample& sample, eval::DepthMethod& method, const ParetoRun& run,
                 bool scored, WayTimes& out) {
    // As in DepthWay, each run is the first one after a still.
    method.setStill(sample.shots.still);
    const auto result = timed(method, sample.shots.frame, run.clock);
    if (scored)
        out.error(scoreOf(sample, result.inverseDepth));
    else
        out.time(result.ms);
}

void measureSample(const DepthSample& sample, const std::vector<DepthSetting>& settings,
                   const ParetoRun& run, std::vector<WayTimes>& times) {
    eval::DepthFactory factory;
    std::vector<std::unique_ptr<eval::DepthMethod>> peers;
    for (const char* name : kDepthPeers)
        peers.push_back(factory.create(name, sample.shots.rig));
    std::vector<std::unique_ptr<DepthWay>> ways;
    for (const DepthSetting& setting : settings)
        ways.push_back(std::make_unique<DepthWay>(sample, setting));
    for (int round = 0; round <= run.rounds; ++round) {
        run.showRound(round);
        for (std::size_t i = 0; i < ways.size(); ++i)
            ways[i]->measure(run, round == 0, times[i]);
        for (std::size_t i = 0; i < peers.size(); ++i)
            measurePeer(sample, *peers[i], run, round == 0, times[ways.size() + i]);
    }
    for (WayTimes& way : times)
        way.endSample();
}

}  // namespace

std::vector<DepthSample> depthSamplesOf(const std::vector<std::filesystem::path>& folders,
                                        std::size_t most) {
    std::vector<DepthSample> out;
    const auto labels = eval::labelsOf(folders);
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const eval::FlowSet set = eval::depthSamplesOf(folders[i]);
        for (std::size_t k = 0; k < std::min(most, set.samples.size()); ++k) {
            // The true flow is NaN at pixels that are occluded in the still. Their depth is set to
            // NaN as well, so that no method is judged there.
            const cv::Mat flow = eval::loadTruth(set, set.samples[k]);
            FloatImage image = loadPfm(set.samples[k].truth);
            cv::Mat inverseDepth = cv::Mat(flow.size(), CV_32F, image.values.data()).clone();
            for (int y = 0; y < flow.rows; ++y)
                for (int x = 0; x < flow.cols; ++x)
                    if (std::isnan(flow.at<cv::Vec2f>(y, x)[0]))
                        inverseDepth.at<float>(y, x) = std::numeric_limits<float>::quiet_NaN();
            out.push_back({{labels[i],
                            set.rig,
                            eval::loadFrame(set, set.samples[k]),
                            eval::loadStill(set, set.samples[k]),
                            {}},
                           inverseDepth});
        }
    }
    return out;
}

std::vector<DepthSample> syntheticDepthSamples(Size video, std::size_t most) {
    std::vector<DepthSample> out;
    for (CurveSample& shots : syntheticCurveSamples(video, most)) {
        SyntheticBoard board(
            handheldOptions(*synthetic::sceneNamed(shots.name), video, shots.rig.still.size));
        FloatImage image = board.inverseDepth(shots.frame.time);
        cv::Mat inverseDepth(image.size.height, image.size.width, CV_32F, image.values.data());
        cv::resize(inverseDepth, inverseDepth, {video.width, video.height}, 0, 0,
                   cv::INTER_NEAREST);
        for (int y = 0; y < inverseDepth.rows; ++y)
            for (int x = 0; x < inverseDepth.cols; ++x)
                if (!(inverseDepth.at<float>(y, x) > 0) ||
                    std::isnan(shots.truth.at<cv::Vec2f>(y, x)[0]))
                    inverseDepth.at<float>(y, x) = std::numeric_limits<float>::quiet_NaN();
        out.push_back({std::move(shots), inverseDepth.clone()});
    }
    return out;
}

ParetoStage depthStage(const std::vector<DepthSample>& samples, const ParetoRun& run) {
    const std::vector<DepthSetting> settings = depthSettings();
    std::vector<WayTimes> times(settings.size() + std::size(kDepthPeers));
    std::vector<std::string> names;
    for (const DepthSample& sample : samples) {
        const ParetoRun one = run.part(names.size(), samples.size(), sample.shots.name);
        names.push_back(sample.shots.name);
        measureSample(sample, settings, one, times);
    }
    if (names.empty()) return {"depth", "bad-1 [%]", "", {}};
    std::vector<std::string> ours;
    for (const DepthSetting& setting : settings)
        ours.emplace_back(setting.name);
    return {"depth", "bad-1 [%]", fmt::format("{}", fmt::join(names, " ")),
            pointsOf(ours, {std::begin(kDepthPeers), std::end(kDepthPeers)}, times)};
}

}  // namespace mfar::bench
