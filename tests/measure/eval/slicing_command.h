#pragma once

#include "tests/measure/eval/slicing.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

/// Adds the subcommand `slicing` with its options, which set `request`.
CLI::App* addSlicingCommand(CLI::App& app, SlicingRequest& request);

}  // namespace mfar::eval
