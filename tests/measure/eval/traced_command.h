#pragma once

#include "tests/measure/eval/traced.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

/// The subcommand `traced` with its options, which fill `request`.
CLI::App* addTracedCommand(CLI::App& app, TracedRequest& request);
/// Evaluates, with a GL context where the engine needs one.
[[nodiscard]] Report runTracedCommand(const TracedRequest& request);

}  // namespace mfar::eval
