#pragma once

#include "tests/measure/eval/report.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mfar::eval {

/// A subcommand and what it does.
struct EvalCommand {
    CLI::App* command;
    std::function<Report()> evaluate;
};

/// What needs the path tracer; nothing where it is not built. `csv` is filled like that of others.
[[nodiscard]] std::vector<EvalCommand> addTracedCommands(CLI::App& app, std::string& csv);

}  // namespace mfar::eval
