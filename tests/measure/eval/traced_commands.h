#pragma once

#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A subcommand and the function that runs it.
struct EvalCommand {
    CLI::App* command;
    std::function<Report(const ProgressPart&)> evaluate;
    bool hasOwnPlot = false;  ///< it has an option --svg of its own
};

/// Subcommands that need the path tracer; empty if it is not built. `csv` is set as by other
/// subcommands.
[[nodiscard]] std::vector<EvalCommand> addTracedCommands(CLI::App& app, std::string& csv);

}  // namespace mfar::eval
