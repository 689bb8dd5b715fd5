#pragma once

#include "tests/measure/eval/pose.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// Adds the subcommand `pose` with its options, which set `request` and `csv`.
CLI::App* addPoseCommand(CLI::App& app, PoseRequest& request, std::string& csv);

}  // namespace mfar::eval
