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
    bool colour = false;      ///< HDR-VDP-2 of the colours instead of luma
    ProgressPart progress{};  ///< what is shown while it runs
};

/// `mfar-eval metric`: metrics of one picture against another.
CLI::App* addMetricCommand(CLI::App& app, MetricRequest& request, std::string& csv);

/// One row. Throws ImageFileError and, for pictures of different size, EvalError.
[[nodiscard]] Report evaluateMetric(const MetricRequest& request);

}  // namespace mfar::eval
