#pragma once

#include "base/progress.h"
#include "tests/measure/bench/pareto_stages.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace mfar::bench {

class ParetoCommand {
public:
    explicit ParetoCommand(CLI::App& app);

    [[nodiscard]] bool asked() const { return command_->parsed(); }
    /// Throws EvalError, RecordingError, ImageFileError and the errors of createGlContext().
    void run(Progress& progress);

private:
    [[nodiscard]] bool wants(const char* stage) const;
    [[nodiscard]] std::vector<ParetoStage> measure(const ProgressPart& progress);
    [[nodiscard]] std::vector<std::filesystem::path> folders() const;

    CLI::App* command_;
    ParetoRun run_;
    std::vector<std::filesystem::path> data_;
    std::vector<std::string> stages_{"flow", "superres", "depth", "slicing", "warp"};
    std::filesystem::path csv_, svg_, table_;
    int frames_ = 0;
    bool quick_ = false;
};

}  // namespace mfar::bench
