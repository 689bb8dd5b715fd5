#include "tests/measure/eval/flow.h"

#include "tests/measure/eval/flow_methods.h"
#include "tests/measure/eval/metrics/flow_error.h"
#include "tests/measure/eval/sample_table.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace mfar::eval {
namespace {

void addRow(Report& report, const SampleRow& row, const FlowMethod::Result& result,
            const cv::Mat& truth) {
    const FlowError error = flowError(result.flow, truth);
    if (error.known == 0)
        throw EvalError(fmt::format("{}: the ground truth has no pixel with a known flow vector",
                                    row.sample.truth.string()));
    // If a method has no result at any pixel, its time and its mean errors are left out.
    const bool answered = error.coverage > 0;
    const auto ofAnswers = [&](double value) {
        return answered && std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    Sparsification sparse{{}, {}, NAN, NAN};
    if (!result.confidence.empty())
        sparse = flowSparsification(result.flow, truth, result.confidence);
    report.add(row.label, row.sample.frame, row.method,
               {ofAnswers(result.ms), ofAnswers(error.epe), error.bad1, error.bad2, error.coverage,
                ofAnswers(error.angular), ofAnswers(sparse.ause), ofAnswers(sparse.ausePerRandom)});
}

}  // namespace

Report evaluateFlow(const SampleRequest& request) {
    Report report({{"ms", 1},
                   {"epe_px", 3},
                   {"bad1", 4},
                   {"bad2", 4},
                   {"coverage", 4},
                   {"angular_deg", 2},
                   {"ause", 4},
                   {"ause_rel", 3}});
    measureSamples<FlowFactory>(
        request, flowSamplesOf, loadTruth,
        [&report](const SampleRow& row, const auto& result, const auto& truth) {
            addRow(report, row, result, truth);
        },
        report);
    return report;
}

}  // namespace mfar::eval
