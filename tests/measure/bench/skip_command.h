#pragma once

#include "base/progress.h"
#include "tests/measure/bench/skips.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace mfar::bench {

class SkipCommand {
public:
    explicit SkipCommand(CLI::App& app);

    [[nodiscard]] bool asked() const { return command_->parsed(); }
    /// Throws EvalError and the errors of createGlContext().
    void run(Progress& progress);

private:
    CLI::App* command_;
    std::filesystem::path svg_;
    SkipRequest request_;
    std::filesystem::path csv_;
};

}  // namespace mfar::bench
