#pragma once

#include "tests/measure/eval/traced.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

CLI::App* addTracedCommand(CLI::App& app, TracedRequest& request);
[[nodiscard]] Report runTracedCommand(const TracedRequest& request);

}  // namespace mfar::eval
