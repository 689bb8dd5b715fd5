#include "tests/measure/bench/skip_command.h"

#include "hal/gl_context.h"
#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <map>

namespace mfar::bench {

SkipCommand::SkipCommand(CLI::App& app)
    : command_(app.add_subcommand(
          "skip", "what each kind of work that is left out saves and which error it adds: every "
                  "case with all of them and with each switched off, frame by frame in turn")) {
    command_->add_option("--cases", request_.cases, "of these alone")
        ->delimiter(',')
        ->check(CLI::IsMember(skipCaseNames()));
    command_->add_option("--skips", request_.skips, "these alone")
        ->delimiter(',')
        ->check(CLI::IsMember(skipNames()));
    command_->add_option("--frames", request_.frames, "frames that count, of each case")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    const std::map<std::string, Clock> clocks{{"wall", Clock::Wall},
                                              {"processor", Clock::Processor}};
    command_
        ->add_option("--clock", request_.clock,
                     "wall, or processor: its time over the number of cores, for a machine "
                     "that others use as well")
        ->transform(CLI::CheckedTransformer(clocks));
    command_->add_option("--csv", csv_, "file for all results");
    command_->add_option("--svg", svg_, "file for a plot");
}

void SkipCommand::run(Progress& progress) {
    request_.progress = ProgressPart(progress);
    const auto context = createGlContext();
    const SkipReport report = measureSkips(request_);
    progress.clear();
    fmt::print("{}\n\n{}", context->description(), skipTable(report));
    if (!csv_.empty()) eval::writeText(csv_, skipCsv(report));
    if (!svg_.empty()) eval::writeText(svg_, skipSvg(report));
}

}  // namespace mfar::bench
