#pragma once

#include "tests/measure/eval/warp.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace mfar::eval {

/// Files that the subcommand writes in addition to its table.
struct WarpFiles {
    std::filesystem::path svg;
};

/// Adds the subcommand `warp` with its options.
CLI::App* addWarpCommand(CLI::App& app, WarpRequest& request, WarpFiles& files);
/// Evaluates the request and writes the plot.
[[nodiscard]] Report runWarpCommand(const WarpRequest& request, const WarpFiles& files);

}  // namespace mfar::eval
