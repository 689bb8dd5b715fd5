#include "tests/measure/bench/bench.h"

#include "tests/measure/bench/gpu_timer.h"
#include "tests/measure/bench/pipeline_run.h"
#include "tests/measure/eval/paper_pipeline.h"
#include "tests/measure/eval/pipeline_shot.h"
#include "tests/measure/eval/still_learning.h"
#include "tests/measure/eval/stopwatch.h"

#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

namespace mfar::bench {
namespace {

// Standard deviation of the noise in the case "rest-noise" [grey levels]
constexpr double kRestNoise = 2;
constexpr std::size_t kWarmUp = 3;
constexpr std::size_t kSetStillRuns = 5;

Workload withoutPoses(Workload work) {
    work.framePoses.clear();
    work.stillPoses.clear();
    if (work.before) work.before->stillPose = work.before->framePose = std::nullopt;
    return work;
}

void warmUp(PipelineRun& ours, std::size_t frames) {
    for (std::size_t i = 0; i < std::min(kWarmUp, frames); ++i)
        ours.run(i);
}

void addTiles(CaseResult& result, const FrameStats& stats) {
    double all = 0;
    for (const int count : stats.tiles)
        all += count;
    for (std::size_t c = 0; c < kTileClasses && all > 0; ++c)
        result.tileShare[c] += stats.tiles[c] / all / static_cast<double>(result.frame.runs);
}

void measureStages(PipelineRun& ours, std::size_t frames, CaseResult& result) {
    std::vector<std::pair<std::string, std::vector<double>>> stages;
    gpu::Timer timer;
    std::vector<double> gpuMs;
    ours.pipeline().setMeasure(true);
    for (std::size_t i = 0; i < frames; ++i) {
        timer.start();
        ours.run(i);
        timer.stop();
        glFinish();
        if (const auto ms = timer.read()) gpuMs.push_back(*ms);
        for (const StageTime& time : ours.pipeline().stageTimes()) {
            auto found = std::find_if(stages.begin(), stages.end(),
                                      [&](const auto& s) { return s.first == time.stage; });
            if (found == stages.end()) found = stages.insert(found, {time.stage, {}});
            found->second.push_back(time.ms);
        }
    }
    ours.pipeline().setMeasure(false);
    for (const auto& [stage, ms] : stages)
        result.stages.push_back({stage, summarise(ms)});
    if (ours.engine() == EngineKind::Gles && !gpuMs.empty())
        result.stages.push_back({"all stages, by the GPU's clock", summarise(gpuMs)});
}

class Peer {
public:
    Peer(std::string name, eval::DisPreset flow, const Workload& work, Size output)
        : name_(std::move(name)), work_(work), paper_(work.rig, output, {flow, 2}) {}

    double run(std::size_t i) {
        if (still_ != work_.stillOf[i]) {
            still_ = work_.stillOf[i];
            paper_.setStill(work_.stills[*still_]);
        }
        return eval::wallMs([&] { paper_.run(work_.frames[i]); });
    }
    void measure(std::size_t i) { ms_.push_back(run(i)); }
    /// `ours`: mfar's times for the same frames [ms].
    [[nodiscard]] PeerResult result(const CaseResult& of, const std::vector<double>& ours) const {
        const Summary own = summarise(ms_);
        std::vector<double> ratios;
        for (std::size_t i = 0; i < ms_.size(); ++i)
            ratios.push_back(ours[i] / ms_[i]);
        std::ranges::sort(ratios);
        const auto at = [&](double share) {
            return ratios[static_cast<std::size_t>(share * static_cast<double>(ratios.size() - 1))];
        };
        return {name_, of.name, own, of.frame.median / own.median, at(0.1), at(0.9)};
    }

private:
    std::string name_;
    const Workload& work_;
    eval::PaperPipeline paper_;
    std::optional<std::size_t> still_;
    std::vector<double> ms_;
};

using Peers = std::vector<std::unique_ptr<Peer>>;

CaseResult measureCase(const std::string& name, PipelineRun& ours, const Workload& work,
                       const Peers& peers, std::vector<PeerResult>& results,
                       const ProgressPart& progress) {
    const std::size_t frames = work.frames.size();
    CaseResult result;
    result.name = name;
    result.frame.runs = frames;
    warmUp(ours, frames);
    for (const auto& peer : peers)
        peer->run(0);
    std::vector<double> ms;
    for (std::size_t i = 0; i < frames; ++i) {
        progress.show(i, frames, frameOf(i, frames));
        ms.push_back(ours.run(i));
        addTiles(result, ours.stats());
        for (const auto& peer : peers)
            peer->measure(i);
    }
    result.frame = summarise(ms);
    for (const auto& peer : peers)
        results.push_back(peer->result(result, ms));
    measureStages(ours, frames, result);
    return result;
}

void measureAgainstPeers(const std::string& name, PipelineRun& ours, const Workload& work,
                         BenchResult& out, const ProgressPart& progress) {
    const Size output = ours.pipeline().outputSize();
    Peers peers;
    peers.push_back(std::make_unique<Peer>("paper", eval::DisPreset::Medium, work, output));
    peers.push_back(std::make_unique<Peer>("paper-fast", eval::DisPreset::Fast, work, output));
    out.cases.push_back(measureCase(name, ours, work, peers, out.peers, progress));
}

}  // namespace

std::shared_ptr<const FilterBank> learnedFrom(const Workload& work) {
    if (work.lessons.empty()) return nullptr;
    eval::StillLearning learning;
    learning.begin(work.rig);
    Pipeline pipeline(
        work.rig,
        {.output = {}, .skipUnchanged = false, .engines = EngineChoice::all(EngineKind::Simd)});
    pipeline.setMatchListener(&learning);
    Timestamp time;
    for (const Lesson& lesson : work.lessons) {
        time = time + std::chrono::seconds(1);
        show(lesson, time, pipeline);
    }
    learning.report("mfar-bench");
    return learning.filters();
}

namespace {

// Has a pipeline of its own: its second still becomes a copy of the newest one.
Summary measureSetStill(const Workload& work, SuperResMode mode, EngineKind engine) {
    PipelineRun ours(work, mode, engine);
    ours.setStill(0);
    std::vector<double> setStill(kSetStillRuns);
    for (double& ms : setStill)
        ms = ours.setStill(0);
    return summarise(std::move(setStill));
}

}  // namespace

BenchResult runBench(const Workload& moving, const Workload& posed, SuperResMode mode,
                     EngineKind engine, const std::string& renderer, const ProgressPart& progress) {
    constexpr std::size_t kParts = 8;
    const Workload blind = withoutPoses(moving);
    PipelineRun ours(blind, mode, engine);
    BenchResult out;
    out.workload = moving.name;
    out.posed = posed.name;
    out.renderer = renderer;
    out.video = moving.rig.video.size;
    out.still = moving.rig.still.size;
    out.output = ours.pipeline().outputSize();
    out.setStill = measureSetStill(blind, mode, engine);
    measureAgainstPeers("moving", ours, blind, out, progress.part(0, kParts, "moving"));
    if (!posed.frames.empty()) {
        PipelineRun handheld(posed, mode, engine);
        measureAgainstPeers("handheld", handheld, posed, out, progress.part(1, kParts, "handheld"));
    }
    for (const double noise : {0.0, kRestNoise}) {
        const Workload rest = atRest(blind, noise);
        PipelineRun resting(rest, mode, engine);
        const char* name = noise > 0 ? "rest-noise" : "rest";
        out.cases.push_back(measureCase(name, resting, rest, {}, out.peers,
                                        progress.part(noise > 0 ? 3 : 2, kParts, name)));
    }
    progress.show(4, kParts, "depth");
    out.depth = measureDepth(posed);
    progress.show(5, kParts, "warp");
    out.warp = measureWarp(out.video, static_cast<int>(moving.frames.size()), engine);
    out.objects = measureObjects(posed, engine, progress.part(6, kParts, "objects"));
    progress.show(7, kParts, "triangulation");
    out.triangulation = measureTriangulation(out.video);
    return out;
}

namespace {

Summary framesOf(const Workload& work, SuperResMode mode, EngineKind engine, int threads,
                 Size output) {
    if (work.frames.empty()) return {};
    PipelineRun ours(work, mode, engine, threads, output);
    warmUp(ours, work.frames.size());
    std::vector<double> ms;
    for (std::size_t i = 0; i < work.frames.size(); ++i)
        ms.push_back(ours.run(i));
    return summarise(std::move(ms));
}

}  // namespace

std::vector<ScalingResult> runScaling(const Workload& moving, const Workload& posed,
                                      SuperResMode mode, EngineKind engine,
                                      const ProgressPart& progress) {
    const Workload blind = withoutPoses(moving);
    const Size full = Pipeline::fullSize(moving.rig);
    std::vector<ScalingResult> out;
    for (const int threads : {1, 2})
        for (const double share : {5.0 / 9, 5.0 / 6, 1.0}) {
            const Size output{static_cast<int>(std::lround(full.width * share)),
                              static_cast<int>(std::lround(full.height * share))};
            progress.show(out.size(), 6,
                          fmt::format("{} threads, {}x{}", threads, output.width, output.height));
            out.push_back({threads, output, framesOf(blind, mode, engine, threads, output),
                           framesOf(posed, mode, engine, threads, output)});
        }
    return out;
}

}  // namespace mfar::bench
