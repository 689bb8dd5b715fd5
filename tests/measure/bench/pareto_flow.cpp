#include "tests/measure/bench/knobs.h"
#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/bench/pareto_timing.h"
#include "tests/measure/eval/flow_methods.h"
#include "tests/measure/eval/metrics/flow_error.h"
#include "tests/measure/eval/picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

namespace mfar::bench {
namespace {

struct FlowSetting {
    std::string name;
    PipelineOptions options;
};

std::vector<FlowSetting> flowSettings(bool withPoses) {
    const std::string method = withPoses ? "epipolar" : "flow2d";
    std::vector<FlowSetting> out{{method, {}}};
    for (const Knob& knob : flowKnobs()) {
        if (knob.method != method) continue;
        for (const double value : knob.values) {
            FlowSetting setting{fmt::format("{} {}", knob.name, value), {}};
            if (value == knob.get(setting.options)) continue;
            knob.set(setting.options, value);
            out.push_back(std::move(setting));
        }
    }
    const auto add = [&](const char* name, const Flow2dOptions& flow2d,
                         const EpipolarOptions& epipolar) {
        out.push_back({name, {}});
        out.back().options.flow2d = flow2d;
        out.back().options.epipolar = epipolar;
    };
    if (withPoses) {
        add("finest 1", {}, {.finest = 1});
        add("finest 1, windowRadius 1", {}, {.windowRadius = 1, .finest = 1});
    } else {
        add("steps 1, planeFits 0", {.steps = 1, .planeFits = 0}, {});
        add("candidates 1, steps 1, planeFits 1", {.candidates = 1, .steps = 1, .planeFits = 1},
            {});
        add("candidates 2, steps 2", {.candidates = 2, .steps = 2}, {});
        add("steps 8, propagations 2", {.steps = 8, .propagations = 2}, {});
    }
    for (FlowSetting& setting : out)
        setting.options.skipUnchanged = false;
    return out;
}

constexpr const char* kBlindPeers[] = {"dis-fast", "dis-medium", "dis-medium-both",
                                       "dis-medium-full", "farneback"};
constexpr const char* kStereoPeers[] = {"sgbm", "stereobm"};

class FlowSampleRun {
public:
    FlowSampleRun(const CurveSample& sample, bool withPoses, const ParetoRun& run)
        : sample_(sample), withPoses_(withPoses), run_(run), pool_(sample.rig),
          frame_(eval::toRgba(sample.frame.picture)), still_(eval::toRgba(sample.still.picture)) {}

    void ours(PipelineOptions options, bool scored, WayTimes& out) {
        options.output = sample_.rig.video.size;
        Pipeline& pipeline = pool_.with(options);
        // Setting the still again discards the previous result, so no run starts from it.
        pipeline.setStill(eval::viewOf(still_), sample_.still.time,
                          withPoses_ ? sample_.still.pose : std::nullopt);
        pipeline.setMeasure(true);
        const double ms = msOf(run_.clock, [&] {
            pipeline.run(eval::viewOf(frame_), sample_.frame.time,
                         withPoses_ ? sample_.frame.pose : std::nullopt);
        });
        if (!scored) return out.time(ms * shareOfStages(pipeline, eval::kFlowStages));
        std::vector<float> vectors = pipeline.readFlow();
        const cv::Mat flow(frame_.size(), CV_32FC2, vectors.data());
        out.error(100 * eval::flowError(flow, sample_.truth).bad1);
    }

    void peer(eval::FlowMethod& method, bool scored, WayTimes& out) const {
        if (scored) method.setStill(sample_.still);
        const auto result = timed(method, sample_.frame, run_.clock);
        if (scored)
            out.error(100 * eval::flowError(result.flow, sample_.truth).bad1);
        else
            out.time(result.ms);
    }

private:
    const CurveSample& sample_;
    bool withPoses_;
    ParetoRun run_;
    PipelinePool pool_;
    cv::Mat frame_, still_;
};

/// Runs all methods on all samples. The first round warms up: its results are scored, but its times
/// are not counted.
class FlowStageRun {
public:
    FlowStageRun(bool withPoses, const ParetoRun& run)
        : withPoses_(withPoses), run_(run), settings_(flowSettings(withPoses)) {
        peers_.assign(std::begin(kBlindPeers), std::end(kBlindPeers));
        if (withPoses)
            peers_.insert(peers_.end(), std::begin(kStereoPeers), std::end(kStereoPeers));
        times_.resize(settings_.size() + peers_.size());
    }

    void measure(const CurveSample& sample, const ParetoRun& run) {
        FlowSampleRun one(sample, withPoses_, run_);
        eval::FlowFactory factory;
        std::vector<std::unique_ptr<eval::FlowMethod>> peers;
        for (const std::string& name : peers_)
            peers.push_back(factory.create(name, sample.rig));
        for (int round = 0; round <= run.rounds; ++round) {
            run.showRound(round);
            for (std::size_t i = 0; i < settings_.size(); ++i)
                one.ours(settings_[i].options, round == 0, times_[i]);
            for (std::size_t i = 0; i < peers.size(); ++i)
                one.peer(*peers[i], round == 0, times_[settings_.size() + i]);
        }
        for (WayTimes& times : times_)
            times.endSample();
    }

    [[nodiscard]] std::vector<ParetoPoint> points() const {
        std::vector<std::string> ours;
        for (const FlowSetting& setting : settings_)
            ours.push_back(setting.name);
        return pointsOf(ours, peers_, times_);
    }

private:
    bool withPoses_;
    ParetoRun run_;
    std::vector<FlowSetting> settings_;
    std::vector<std::string> peers_;
    std::vector<WayTimes> times_;
};

}  // namespace

ParetoStage flowStage(const std::vector<CurveSample>& samples, bool withPoses,
                      const ParetoRun& run) {
    FlowStageRun all(withPoses, run);
    std::vector<std::string> names;
    for (const CurveSample& sample : samples) {
        if (withPoses && !sample.hasPoses()) continue;
        all.measure(sample, run.part(names.size(), samples.size(), sample.name));
        names.push_back(sample.name);
    }
    ParetoStage out{withPoses ? "flow with poses" : "flow without poses",
                    "bad-1 [%]",
                    fmt::format("{}", fmt::join(names, " ")),
                    {}};
    if (!names.empty()) out.points = all.points();
    return out;
}

}  // namespace mfar::bench
