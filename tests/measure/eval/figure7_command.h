#pragma once

#include "tests/measure/eval/figure7.h"

#include <CLI/CLI.hpp>

#include <string>

namespace mfar::eval {

CLI::App* addFigure7Command(CLI::App& app, Figure7Request& request, std::string& csv);

/// Evaluates the request, writes its files and prints the summary. Throws EvalError,
/// RecordingError and ImageFileError.
[[nodiscard]] Report runFigure7(const Figure7Request& request);

}  // namespace mfar::eval
