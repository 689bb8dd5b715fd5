#pragma once

#include "tests/measure/eval/slicing.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

CLI::App* addSlicingCommand(CLI::App& app, SlicingRequest& request);

}  // namespace mfar::eval
