#include "daemon/after_output.h"
#include "daemon/output_checks.h"
#include "daemon/tools/command_failure.h"
#include "hal/gl_context.h"
#include "tests/measure/bench/bench.h"
#include "tests/measure/bench/bench_report.h"
#include "tests/measure/bench/curve_report.h"
#include "tests/measure/bench/governor_command.h"
#include "tests/measure/bench/pareto_command.h"
#include "tests/measure/bench/skip_command.h"
#include "tests/measure/bench/workload.h"
#include "tests/measure/eval/engine_option.h"
#include "tests/measure/eval/program_end.h"
#include "tests/measure/eval/report.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace mfar;
using namespace mfar::bench;

constexpr const char* kHelp =
    "mfar-bench: measures the run time of every stage and of whole super-resolved frames.\n"
    "Cases:\n"
    "moving: every frame differs from the one before, and there are no poses; handheld: the "
    "synthetic office seen by a hand-held camera with its exact poses, or the recording's frames "
    "with its poses; rest: the same frame again and again; rest-noise: the same view with sensor "
    "noise of sigma 2 grey levels.\n"
    "mfar learns its filters from stills before the measurement. Whole frames are timed without "
    "interruption until the picture is finished; stages are timed in a separate run. Rows "
    "`objects`: frames of handheld at 30 Hz with a path-traced model, while the path tracer works "
    "and while it has no work. Rows `peer "
    "paper` and `peer paper-fast` are for comparison: the paper's method with OpenCV's flow (DIS "
    "medium, DIS fast). It processes each frame right after mfar.";

struct Options {
    std::string recording, json, mode = "detail", engine = "auto";
    int frames = 0;
    bool quick = false, scaling = false, shipped = false;
    std::filesystem::path curves, svg;
    std::vector<std::filesystem::path> data;
};

/// Workloads of a moving camera, without and with poses. A workload without frames is not measured.
struct Workloads {
    Workload moving, posed;
};

bool isMoving(const Workload& work) {
    return std::ranges::any_of(work.frames, [&](const cv::Mat& frame) {
        return cv::norm(frame, work.frames.front(), cv::NORM_INF) > 0;
    });
}

Workloads workloadsFor(const Options& o) {
    const int frames = o.frames > 0 ? o.frames : (o.quick ? 4 : 40);
    if (frames < 2) throw eval::EvalError("--frames must be at least 2, so that the camera moves");
    if (o.recording.empty()) {
        const Size video = o.quick ? Size{160, 120} : Size{640, 480};
        const Size still = o.quick ? Size{576, 432} : Size{2304, 1728};
        return {syntheticWorkload(video, still, frames, kLessons),
                handheldWorkload(video, still, frames, kLessons)};
    }
    Workloads out{recordedWorkload(o.recording, frames), {}};
    if (!isMoving(out.moving))
        throw eval::EvalError(o.recording + ": all frames are equal; the benchmark needs a moving "
                                            "camera");
    const auto known = [](const std::vector<std::optional<Pose>>& poses) {
        return std::ranges::all_of(poses, [](const auto& pose) { return pose.has_value(); });
    };
    if (known(out.moving.framePoses) && known(out.moving.stillPoses)) out.posed = out.moving;
    return out;
}

std::vector<CurveSample> curveSamplesFor(const Options& o) {
    namespace fs = std::filesystem;
    std::vector<fs::path> folders = o.data;
    if (folders.empty() && !o.quick)
        for (const char* name : {"motorcycle", "books", "dolls", "teddy"})
            if (const fs::path folder = fs::path(MFAR_SHARED_DATA) / name; fs::exists(folder))
                folders.push_back(folder);
    if (folders.empty())
        return o.quick ? syntheticCurveSamples({160, 120}, 1) : syntheticCurveSamples({640, 480});
    return curveSamplesOf(folders, o.frames > 0 ? static_cast<std::size_t>(o.frames) : 2);
}

void drawCurves(const Options& o, Progress& progress) {
    const std::vector<CurveSample> samples = curveSamplesFor(o);
    const auto context = createGlContext();
    const Curves curves = measureCurves(samples, ProgressPart(progress));
    progress.clear();
    writeCurves(curves, o.curves);
    fmt::print("{}\n{}", eval::engineAndRenderer(*context), curvesCsv(curves));
}

void addOptions(CLI::App& app, Options& o) {
    app.add_option("--recording", o.recording,
                   "use the frames and stills of this recording instead of synthetic ones");
    app.add_option("--frames", o.frames, "number of frames per case (default 40, with --quick 4)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--mode", o.mode, "super-resolution mode, see superres.mode in mfard's manual")
        ->check(CLI::IsMember({"detail", "blend"}))
        ->capture_default_str();
    eval::addEngine(app, o.engine);
    app.add_flag("--as-shipped", o.shipped,
                 "use the shipped filters, as mfar does before the first still");
    app.add_flag("--scaling", o.scaling,
                 "also measure frame times with one and two threads at three output sizes");
    app.add_option("--json", o.json, "file to write all results into")->check(fileToWrite());
    app.add_option("--svg", o.svg, "file to write a plot of the times into")->check(fileToWrite());
    app.add_flag("--quick", o.quick,
                 "measure few small frames, only to check that the program runs");
    app.add_option("--curves", o.curves,
                   "measure only the flow: time against error for several values of each option; "
                   "write curves.csv and curves.svg into this folder");
    app.add_option(
           "--data", o.data,
           "recordings or pairs on which the curves are measured, as for mfar-eval flow; "
           "--frames is the number of samples of each (default 2). Without --data, the "
           "curves are measured on the stereo pairs in ../shared/data. If these are absent, "
           "or with --quick, they are measured on synthetic scenes")
        ->needs("--curves");
}

void write(const BenchResult& result, const Options& o) {
    fmt::print("{}", toTable(result));
    if (!o.json.empty()) eval::writeText(o.json, toJson(result).dump(2) + "\n");
    if (!o.svg.empty()) eval::writeText(o.svg, benchSvg(result));
}

/// Throws EvalError if an option is given that has no effect on the command, or on --curves.
void requireEffect(const CLI::App& app, const Options& o) {
    const bool isCommand = !app.get_subcommands().empty();
    if (!isCommand && o.curves.empty()) return;
    std::vector<std::string> used{"--engine"};
    if (!isCommand) used.insert(used.end(), {"--curves", "--data", "--frames", "--quick"});
    for (const CLI::Option* option : app.get_options())
        if (option->count() > 0 && !std::ranges::count(used, option->get_name()))
            throw eval::EvalError(
                fmt::format("{} has no effect on {}", option->get_name(),
                            isCommand ? "the command " + app.get_subcommands().front()->get_name()
                                      : "--curves"));
}

int run(int argc, char** argv) {
    CLI::App app(kHelp);
    app.failure_message(commandFailure);
    Options o;
    addOptions(app, o);
    ParetoCommand pareto(app);
    SkipCommand skip(app);
    GovernorCommand governor(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : eval::kWrongInput;
    }
    requireEffect(app, o);
    eval::useEngine(o.engine);
    Progress progress;
    const ProgressPart all(progress);
    if (pareto.asked()) return pareto.run(progress), 0;
    if (skip.asked()) return skip.run(progress), 0;
    if (governor.asked()) return governor.run(progress), 0;
    if (!o.curves.empty()) return drawCurves(o, progress), 0;
    all.show(0, 1, "making the frames");
    auto [moving, posed] = workloadsFor(o);
    const auto context = createGlContext();
    if (!o.shipped)
        for (Workload* work : {&moving, &posed})
            work->filters = learnedFrom(*work);
    const SuperResMode mode = o.mode == "blend" ? SuperResMode::Blend : SuperResMode::Detail;
    const EngineKind engine = EngineChoice::fromEnvironment().detail;
    const int parts = o.scaling ? 3 : 2;
    BenchResult result = runBench(moving, posed, mode, engine, eval::engineAndRenderer(*context),
                                  all.part(0, parts, ""));
    if (o.scaling)
        result.scaling = runScaling(moving, posed, mode, engine, all.part(1, parts, "scaling"));
    all.part(parts - 1, parts, "").show(0, 1, "path tracer");
    result.render = measureRender(o.quick);
    progress.clear();
    write(result, o);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return afterOutput(run(argc, argv), "mfar-bench", 1);
    } catch (const std::exception& error) {
        return eval::endedBy(error, "mfar-bench");
    }
}
