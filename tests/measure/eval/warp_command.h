#pragma once

#include "tests/measure/eval/warp.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace mfar::eval {

struct WarpFiles {
    std::filesystem::path svg;
};

CLI::App* addWarpCommand(CLI::App& app, WarpRequest& request, WarpFiles& files);
[[nodiscard]] Report runWarpCommand(const WarpRequest& request, const WarpFiles& files);

}  // namespace mfar::eval
