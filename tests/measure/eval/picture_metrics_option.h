#pragma once

#include "tests/measure/eval/picture_metrics.h"

#include <CLI/CLI.hpp>

namespace mfar::eval {

extern const char* const kPictureMetricsHelp;

void addPictureMetrics(CLI::App& sub, PictureMetrics& metrics);
/// Adds only the parameters: --ppd, --peak, --black, --gamma, --lpc-ratio.
void addMetricParameters(CLI::App& sub, PictureMetrics& metrics);

}  // namespace mfar::eval
