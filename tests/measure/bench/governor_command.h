#pragma once

#include "base/progress.h"
#include "tests/measure/bench/governor_run.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace mfar::bench {

class GovernorCommand {
public:
    explicit GovernorCommand(CLI::App& app);

    [[nodiscard]] bool asked() const { return command_->parsed(); }
    /// Throws ConfigError if the file with the quality levels is invalid, Failure if it cannot be
    /// read, EvalError if the plot cannot be written, and the errors of createGlContext().
    void run(Progress& progress);

private:
    CLI::App* command_;
    std::filesystem::path svg_;
    GovernorRequest request_;
    std::filesystem::path table_;
};

}  // namespace mfar::bench
