#pragma once

#include "tests/measure/eval/pose.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// The subcommand `pose` with its options, which fill `request` and `csv`.
CLI::App* addPoseCommand(CLI::App& app, PoseRequest& request, std::string& csv);

}  // namespace mfar::eval
