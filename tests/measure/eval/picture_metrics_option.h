#pragma once

#include "tests/measure/eval/picture_metrics.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

/// What every help says of the measures and their parameters.
extern const char* const kPictureMetricsHelp;

/// Adds `--metrics`, whose default is what `metrics` holds, and what goes with it.
void addPictureMetrics(CLI::App& sub, PictureMetrics& metrics);
/// Adds only how the measures look: --ppd, --peak, --black, --gamma, --lpc-ratio.
void addMetricParameters(CLI::App& sub, PictureMetrics& metrics);

}  // namespace mfar::eval
