#pragma once

#include "tests/measure/eval/occlusion.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

CLI::App* addOcclusionCommand(CLI::App& app, OcclusionRequest& request, std::string& csv);

}  // namespace mfar::eval
