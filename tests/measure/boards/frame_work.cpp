// Measures the work per frame for `./run board-report`, which predicts the speed on a board. For
// GLES, lists every draw and dispatch with its invocations and bytes. For SIMD, only runs the
// frames: the report runs this program in an emulator that counts its instructions. With --time,
// lists the time of each stage instead.

#include "hal/gl_context.h"
#include "pipeline/enlarge/prior_filters.h"
#include "pipeline/pipeline.h"
#include "tests/measure/bench/workload.h"
#include "tests/measure/boards/pass_recorder.h"
#include "tests/measure/eval/picture.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <hwy/targets.h>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mfar::boards {
namespace {

using Json = nlohmann::json;

struct Options {
    std::string engine = "simd", shown = "moving", recording;
    int frames = 3, threads = 1, width = 2304;
    bool time = false, avx2 = false;
};

/// The shipped filters, with values for Guidance and FineMatch, which otherwise only learning adds.
/// With these values, a frame needs the same work as with learned filters.
std::shared_ptr<const FilterBank> learnedFilters() {
    return std::make_shared<FilterBank>(readFilters(enlarge::priorFilters(), "prior"),
                                        Guidance{0.5F, 0.5F, 0.5F}, FineMatch{4.0F, 0.1F});
}

class Frames {
public:
    explicit Frames(const Options& options) : options_(options), work_(workload(options)) {
        PipelineOptions o;
        o.engines = EngineChoice::all(kind());
        o.threads = options.threads;
        const Size full = Pipeline::fullSize(work_.rig);
        o.output = {options.width, options.width * full.height / full.width};
        pipeline_ = std::make_unique<Pipeline>(work_.rig, o);
        pipeline_->setFilters(learnedFilters());
        for (const cv::Mat& frame : work_.frames)
            frames_.push_back(eval::toRgba(frame));
        still_ = eval::toRgba(work_.stills[0]);
    }
    void setStill() {
        const auto pose = work_.stillPoses.empty() ? std::nullopt : work_.stillPoses[0];
        pipeline_->setStill(eval::viewOf(still_), next(), pose);
        pipeline_->finish(kind());
    }
    void run(std::size_t i) {
        const auto pose = work_.framePoses.empty() ? std::nullopt : work_.framePoses[i];
        pipeline_->run(eval::viewOf(frames_[i]), next(), pose);
        pipeline_->finish(kind());
    }
    [[nodiscard]] std::size_t count() const { return frames_.size(); }
    [[nodiscard]] Pipeline& pipeline() { return *pipeline_; }

private:
    static bench::Workload workload(const Options& o) {
        if (!o.recording.empty()) return bench::recordedWorkload(o.recording, o.frames);
        const bench::Workload moving = bench::syntheticWorkload({640, 480}, {2304, 1728}, o.frames);
        return o.shown == "rest" ? bench::atRest(moving, 0) : moving;
    }
    [[nodiscard]] EngineKind kind() const {
        return options_.engine == "gles" ? EngineKind::Gles : EngineKind::Simd;
    }
    Timestamp next() { return time_ = time_ + std::chrono::nanoseconds{33'333'333}; }

    Options options_;
    bench::Workload work_;
    std::unique_ptr<Pipeline> pipeline_;
    std::vector<cv::Mat> frames_;
    cv::Mat still_;
    Timestamp time_;
};

Json recorded(const PassRecorder& recorder) {
    Json out = Json::array();
    for (const PassWork& work : recorder.passes())
        out.push_back(jsonOf(work));
    return out;
}

Json passesOf(Frames& frames) {
    Json out;
    {
        const PassRecorder still;
        frames.setStill();
        out["still"] = recorded(still);
    }
    for (std::size_t i = 0; i + 1 < frames.count(); ++i)
        frames.run(i);
    const PassRecorder last;
    frames.run(frames.count() - 1);
    out["frame"] = recorded(last);
    return out;
}

/// Current clock of this processor [GHz], measured with a chain of additions. Each addition depends
/// on the previous one and takes one cycle.
double clockGhz() {
    constexpr int kAdditions = 50'000'000;
    using Clock = std::chrono::steady_clock;
    double most = 0;
    for (int run = 0; run < 5; ++run) {
        std::uint64_t sum = 0;
        const auto begin = Clock::now();
        for (int i = 0; i < kAdditions; i += 8)
            for (int k = 0; k < 8; ++k) {
                ++sum;
                asm volatile("" : "+r"(sum));
            }
        const std::chrono::duration<double, std::nano> taken = Clock::now() - begin;
        most = std::max(most, kAdditions / taken.count());
    }
    return most;
}

constexpr int kWarmUp = 3;

/// Median, least and largest time of each stage and of the whole frame [ms]. The first kWarmUp
/// frames are not counted.
Json timesOf(Frames& frames) {
    std::map<std::string, std::vector<double>> ms;
    frames.setStill();
    frames.pipeline().setMeasure(true);
    for (std::size_t i = 0; i < frames.count(); ++i) {
        frames.run(i);
        if (std::cmp_less(i, kWarmUp)) continue;
        double sum = 0;
        for (const StageTime& time : frames.pipeline().stageTimes()) {
            ms[time.stage].push_back(time.ms);
            sum += time.ms;
        }
        ms["frame"].push_back(sum);
    }
    Json out;
    out["clockGhz"] = clockGhz();
    for (auto& [stage, times] : ms) {
        std::ranges::sort(times);
        out[stage] = {
            {"median", times[times.size() / 2]}, {"least", times.front()}, {"most", times.back()}};
    }
    return out;
}

int run(int argc, char** argv) {
    CLI::App app("mfar-frame-work: measures the work of a frame, from which ./run board-report "
                 "predicts the speed on a board");
    Options o;
    app.add_option("--engine", o.engine, "engine of all steps")
        ->check(CLI::IsMember({"gles", "simd"}));
    CLI::Option* const shown =
        app.add_option("--case", o.shown, "moving: every frame differs; rest: all frames are equal")
            ->check(CLI::IsMember({"moving", "rest"}));
    app.add_option("--recording", o.recording,
                   "use the pictures and poses of this recording instead of synthetic ones")
        ->excludes(shown);
    app.add_option("--frames", o.frames, "number of frames")->check(CLI::Range(1, 1000));
    app.add_option("--threads", o.threads, "number of threads")->check(CLI::Range(1, 64));
    app.add_option("--width", o.width, "width of the output [px]")->check(CLI::Range(64, 8192));
    app.add_flag("--time", o.time, "time each stage instead of counting its work");
    app.add_flag("--avx2", o.avx2,
                 "use no instruction set newer than AVX2, the newest that the emulator has");
    CLI11_PARSE(app, argc, argv);
    if (o.time && o.frames <= kWarmUp)
        throw std::invalid_argument("--time needs --frames 4 or more, because the first three "
                                    "frames are not counted");
    if (o.avx2) hwy::DisableTargets(HWY_AVX2 - 1);
    std::unique_ptr<GlContext> context;
    if (o.engine == "gles") context = createGlContext();
    Frames frames(o);
    Json out;
    if (o.time) {
        out = timesOf(frames);
    } else if (o.engine == "gles") {
        out = passesOf(frames);
    } else {
        frames.setStill();
        for (std::size_t i = 0; i < frames.count(); ++i)
            frames.run(i);
    }
    std::printf("%s\n", out.dump(1).c_str());
    return 0;
}

}  // namespace
}  // namespace mfar::boards

int main(int argc, char** argv) {
    try {
        return mfar::boards::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "mfar-frame-work: %s\n", error.what());
        return 1;
    }
}
