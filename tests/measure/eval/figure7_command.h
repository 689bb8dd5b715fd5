#pragma once

#include "tests/measure/eval/figure7.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

/// Adds the subcommand `figure7` with its options, which set `request` and `csv`.
CLI::App* addFigure7Command(CLI::App& app, Figure7Request& request, std::string& csv);

/// Measures, draws what the request asks for, and prints the summary. Throws EvalError and
/// RecordingError.
[[nodiscard]] Report runFigure7(const Figure7Request& request);

}  // namespace mfar::eval
