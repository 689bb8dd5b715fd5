#pragma once

#include "tests/measure/eval/slicing.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

/// The subcommand `slicing` with its options, which fill `request`.
CLI::App* addSlicingCommand(CLI::App& app, SlicingRequest& request);

}  // namespace mfar::eval
