#pragma once

#include "base/progress.h"
#include "tests/measure/eval/report.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mfar::eval {

struct EvalCommand {
    CLI::App* command;
    std::function<Report(const ProgressPart&)> evaluate;
    bool hasOwnPlot = false;
};

/// Adds and returns the subcommands that need the path tracer. Without the path tracer, adds none.
[[nodiscard]] std::vector<EvalCommand> addTracedCommands(CLI::App& app, std::string& csv);

}  // namespace mfar::eval
