#pragma once

#include "tests/measure/eval/occlusion.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// The subcommand `occlusion` with its options, which fill `request` and `csv`.
CLI::App* addOcclusionCommand(CLI::App& app, OcclusionRequest& request, std::string& csv);

}  // namespace mfar::eval
