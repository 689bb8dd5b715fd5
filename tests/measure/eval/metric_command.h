#pragma once

#include "base/progress.h"
#include "tests/measure/eval/picture_metrics.h"
#include "tests/measure/eval/report.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>

namespace mfar::eval {

struct MetricRequest {
    std::filesystem::path test, reference;
    PictureMetrics metrics{pictureMetricNames(), {}};
    bool colour = false;
    ProgressPart progress{};
};

CLI::App* addMetricCommand(CLI::App& app, MetricRequest& request, std::string& csv);

/// Compares two pictures in a report with one row. Throws ImageFileError, and EvalError if the
/// pictures differ in size.
[[nodiscard]] Report evaluateMetric(const MetricRequest& request);

}  // namespace mfar::eval
