#include "tests/measure/bench/pareto_command.h"

#include "daemon/output_checks.h"
#include "daemon/quality_table.h"
#include "hal/gl_context.h"
#include "tests/measure/bench/pareto.h"
#include "tests/measure/eval/engine_option.h"
#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mfar::bench {
namespace {

namespace fs = std::filesystem;

// Least ratio of the run times of two neighbouring quality levels. If two levels are closer, the
// faster one is left out, because it hardly saves time.
constexpr double kLeastStep = 1.05;

/// Quality levels from fast to accurate: the points of mfar that no other point of mfar dominates.
std::vector<QualityLevel> levelsOf(const ParetoStage& superres) {
    std::vector<ParetoPoint> ours;
    for (const ParetoPoint& p : superres.points)
        if (p.kind != ParetoPoint::Kind::Peer) ours.push_back(p);
    std::map<std::string, Quality> settings;
    for (QualitySetting& setting : qualitySettings())
        settings[setting.name] = setting.quality;
    std::vector<QualityLevel> out;
    for (const std::size_t i : paretoFront(ours)) {
        const ParetoPoint& p = ours[i];
        const double psnr = 20 * std::log10(255 / std::max(p.error, 1e-3));
        if (!out.empty() && p.ms < kLeastStep * out.back().ms) out.pop_back();
        out.push_back({p.name, p.ms, psnr, settings.at(p.name)});
    }
    return out;
}

}  // namespace

ParetoCommand::ParetoCommand(CLI::App& app)
    : command_(app.add_subcommand("pareto",
                                  "run time against error: measures flow, super-resolution, depth, "
                                  "slicing and warp with every setting of mfar and with other "
                                  "methods; each of these gives a point (median time, error)")) {
    command_
        ->add_option("--stages", stages_,
                     fmt::format("stages to measure: any of {}", fmt::join(stages_, ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(stages_));
    command_->add_option("--data", data_,
                         "recordings on which flow and depth are measured, as for mfar-eval; flow "
                         "can also be measured on pairs of frames. Default: the stereo pairs in "
                         "../shared/data; if these are absent, or with --quick: synthetic scenes");
    command_
        ->add_option("--frames", frames_,
                     "number of samples from each folder (default 2) and number of frames of each "
                     "synthetic sequence (default 12, with --quick 3)")
        ->check(CLI::Range(1, 1000));
    command_
        ->add_option("--rounds", run_.rounds,
                     "number of timed repetitions of each setting of flow, superres and depth")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    const std::map<std::string, Clock> clocks{{"wall", Clock::Wall},
                                              {"processor", Clock::Processor}};
    command_
        ->add_option("--clock", run_.clock,
                     "clock for flow, superres and depth: wall, or processor (processor time "
                     "divided by the number of cores; use it if other programs run at the same "
                     "time)")
        ->transform(CLI::CheckedTransformer(clocks));
    command_->add_option("--csv", csv_, "file to write all points into")->check(fileToWrite());
    command_->add_option("--svg", svg_, "file to write a plot with the Pareto fronts into")
        ->check(fileToWrite());
    command_
        ->add_option(
            "--table", table_,
            "file to write the governor's quality levels into; they are the Pareto front of "
            "super-resolution")
        ->check(fileToWrite());
    command_->add_flag("--quick", quick_,
                       "measure few small frames, only to check that the program runs");
}

bool ParetoCommand::wants(const char* stage) const {
    return std::ranges::find(stages_, stage) != stages_.end();
}

std::vector<fs::path> ParetoCommand::folders() const {
    std::vector<fs::path> out = data_;
    if (out.empty() && !quick_)
        for (const char* name : {"motorcycle", "books", "dolls", "teddy"})
            if (const fs::path folder = fs::path(MFAR_SHARED_DATA) / name; fs::exists(folder))
                out.push_back(folder);
    return out;
}

std::vector<ParetoStage> ParetoCommand::measure(const ProgressPart& progress) {
    std::size_t begun = 0;
    const auto isNext = [&](const char* stage) {
        if (!wants(stage)) return false;
        run_.progress = progress.part(begun++, stages_.size(), stage);
        run_.progress.show(0, 1, "");
        return true;
    };
    const Size video = quick_ ? Size{160, 120} : Size{640, 480};
    const Size still = quick_ ? Size{576, 432} : Size{2304, 1728};
    const auto given = folders();
    const std::size_t scenes = quick_ ? 1 : 2;
    const auto samples = static_cast<std::size_t>(frames_ > 0 ? frames_ : 2);
    std::vector<ParetoStage> out;
    if (isNext("flow")) {
        auto shots =
            given.empty() ? syntheticCurveSamples(video, scenes) : curveSamplesOf(given, samples);
        if (quick_) shots.resize(1);
        out.push_back(flowStage(shots, true, run_.part(0, 2, "with poses")));
        out.push_back(flowStage(shots, false, run_.part(1, 2, "without poses")));
    }
    if (isNext("superres")) {
        const int frames = frames_ > 0 ? frames_ : (quick_ ? 3 : 12);
        out.push_back(superResStage(syntheticSequences(video, still, frames, scenes), run_));
    }
    if (isNext("depth")) {
        auto shots =
            given.empty() ? syntheticDepthSamples(video, scenes) : depthSamplesOf(given, samples);
        if (quick_) shots.resize(1);
        out.push_back(depthStage(shots, run_));
    }
    if (isNext("slicing")) out.push_back(slicingStage(quick_));
    if (isNext("warp")) out.push_back(warpStage(quick_));
    std::erase_if(out, [](const ParetoStage& stage) { return stage.points.empty(); });
    return out;
}

void ParetoCommand::run(Progress& progress) {
    if (!table_.empty() && !wants("superres"))
        throw eval::EvalError("--table needs the stage superres; add it to --stages");
    const auto context = createGlContext();
    const std::vector<ParetoStage> stages = measure(ProgressPart(progress));
    progress.clear();
    fmt::print("{}\n\n{}", eval::engineAndRenderer(*context), paretoSummary(stages));
    if (!csv_.empty()) eval::writeText(csv_, paretoCsv(stages));
    if (!svg_.empty()) eval::writeText(svg_, paretoSvg(stages));
    for (const ParetoStage& stage : stages)
        if (!table_.empty() && stage.name == "super-resolution")
            eval::writeText(
                table_, "# Measured by mfar-bench pareto: " + eval::engineAndRenderer(*context) +
                            "\n\n" + toToml(levelsOf(stage)));
}

}  // namespace mfar::bench
