#include "tests/measure/bench/skip_command.h"

#include "daemon/output_checks.h"
#include "hal/gl_context.h"
#include "tests/measure/eval/engine_option.h"
#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <map>

namespace mfar::bench {

SkipCommand::SkipCommand(CLI::App& app)
    : command_(app.add_subcommand(
          "skip", "shows how much time each kind of skipped work saves and how much error it adds: "
                  "runs every case with all skips, and with each skip switched off; these variants "
                  "take turns at each frame")) {
    command_->add_option("--cases", request_.cases, "cases to measure (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(skipCaseNames()));
    command_->add_option("--skips", request_.skips, "skips to measure (default: all)")
        ->delimiter(',')
        ->check(CLI::IsMember(skipNames()));
    command_->add_option("--frames", request_.frames, "number of measured frames of each case")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    const std::map<std::string, Clock> clocks{{"wall", Clock::Wall},
                                              {"processor", Clock::Processor}};
    command_
        ->add_option("--clock", request_.clock,
                     "clock of the measurement: wall, or processor (processor time divided by the "
                     "number of cores; use it if other programs run at the same time)")
        ->transform(CLI::CheckedTransformer(clocks));
    command_->add_flag("--quick", request_.quick,
                       "measure small pictures, only to check that the program runs");
    command_->add_option("--csv", csv_, "file to write all results into")->check(fileToWrite());
    command_->add_option("--svg", svg_, "file to write a plot into")->check(fileToWrite());
}

void SkipCommand::run(Progress& progress) {
    request_.progress = ProgressPart(progress);
    const auto context = createGlContext();
    const SkipReport report = measureSkips(request_);
    progress.clear();
    fmt::print("{}\n\n{}", eval::engineAndRenderer(*context), skipTable(report));
    if (!csv_.empty()) eval::writeText(csv_, skipCsv(report));
    if (!svg_.empty()) eval::writeText(svg_, skipSvg(report));
}

}  // namespace mfar::bench
