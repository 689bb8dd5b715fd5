#pragma once

#include "tests/measure/bench/skips.h"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace mfar::bench {

/// `mfar-bench skip`: measures the time saved and the accuracy lost by skipping work.
class SkipCommand {
public:
    explicit SkipCommand(CLI::App& app);

    [[nodiscard]] bool asked() const { return command_->parsed(); }
    /// Throws EvalError.
    void run() const;

private:
    CLI::App* command_;
    SkipRequest request_;
    std::filesystem::path csv_;
};

}  // namespace mfar::bench
