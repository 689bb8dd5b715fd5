#pragma once

#include "tests/measure/eval/traced.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

/// Adds the subcommand `traced` with its options, which set `request`.
CLI::App* addTracedCommand(CLI::App& app, TracedRequest& request);
/// Evaluates the request; creates a GL context if the engine needs one.
[[nodiscard]] Report runTracedCommand(const TracedRequest& request);

}  // namespace mfar::eval
