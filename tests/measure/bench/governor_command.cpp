#include "tests/measure/bench/governor_command.h"

#include "daemon/governor_config.h"
#include "daemon/number_range.h"
#include "daemon/output_checks.h"
#include "hal/gl_context.h"
#include "tests/measure/eval/engine_option.h"
#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <map>

namespace mfar::bench {

GovernorCommand::GovernorCommand(CLI::App& app)
    : command_(app.add_subcommand("governor",
                                  "shows how the governor keeps deadlines: runs four scenes one "
                                  "after the other and prints for each deadline the 95th "
                                  "percentile of the frame times, the number of late frames, the "
                                  "number of frames until the governor settled, and the frames at "
                                  "each quality level")) {
    command_
        ->add_option("--deadlines", request_.deadlinesMs,
                     "deadlines of a frame [ms] (default 33,66,133)")
        ->delimiter(',')
        ->check(numberFrom(0.1, 10000));
    command_->add_option("--frames", request_.frames, "number of frames of each scene")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    command_->add_option("--svg", svg_, "file to write a plot of the times of all frames into")
        ->check(fileToWrite());
    command_->add_option(
        "--table", table_,
        "file with the quality levels, as written by mfar-bench pareto --table FILE");
    const std::map<std::string, Clock> clocks{{"wall", Clock::Wall},
                                              {"processor", Clock::Processor}};
    command_
        ->add_option("--clock", request_.clock,
                     "clock of the measurement: wall, or processor (processor time divided by the "
                     "number of cores; use it if other programs run at the same time)")
        ->transform(CLI::CheckedTransformer(clocks));
    command_->add_flag("--quick", request_.quick,
                       "measure small pictures, only to check that the program runs");
}

void GovernorCommand::run(Progress& progress) {
    request_.progress = ProgressPart(progress);
    GovernorConfig config;
    config.deadlineMs = request_.deadlinesMs.front();
    config.table = table_;
    const std::vector<QualityLevel> levels = governedLevels(config);
    const auto context = createGlContext();
    const auto runs = measureGovernor(request_, levels);
    progress.clear();
    fmt::print("{}\n\n{}", eval::engineAndRenderer(*context), governorTable(runs));
    if (!svg_.empty()) eval::writeText(svg_, governorSvg(runs));
}

}  // namespace mfar::bench
