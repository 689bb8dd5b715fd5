#pragma once

#include "tests/measure/eval/pose.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

CLI::App* addPoseCommand(CLI::App& app, PoseRequest& request, std::string& csv);

}  // namespace mfar::eval
