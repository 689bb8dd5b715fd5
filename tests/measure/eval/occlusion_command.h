#pragma once

#include "tests/measure/eval/occlusion.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// Adds the subcommand `occlusion` with its options, which set `request` and `csv`.
CLI::App* addOcclusionCommand(CLI::App& app, OcclusionRequest& request, std::string& csv);

}  // namespace mfar::eval
