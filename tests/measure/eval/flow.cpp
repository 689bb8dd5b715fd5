#include "tests/measure/eval/flow.h"

#include "tests/measure/eval/flow_methods.h"
#include "tests/measure/eval/labels.h"
#include "tests/measure/eval/metrics/flow_error.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace mfar::eval {
namespace {

void addRow(Report& report, const std::string& label, const FlowSample& sample,
            const std::string& method, const FlowMethod::Result& result, const cv::Mat& truth) {
    const FlowError error = flowError(result.flow, truth);
    if (error.known == 0)
        throw EvalError(fmt::format("{}: no vector is known", sample.truth.string()));
    // A method that had no answer was not at work either.
    const bool answered = error.coverage > 0;
    const auto ofAnswers = [&](double value) {
        return answered && std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    Sparsification sparse{{}, {}, NAN, NAN};
    if (!result.confidence.empty())
        sparse = flowSparsification(result.flow, truth, result.confidence);
    report.add(label, sample.frame, method,
               {ofAnswers(result.ms), ofAnswers(error.epe), error.bad1, error.bad2, error.coverage,
                ofAnswers(error.angular), ofAnswers(sparse.ause), ofAnswers(sparse.ausePerRandom)});
}

void measure(const SampleRun& run, const std::vector<std::string>& names, FlowFactory& factory,
             Report& report) {
    std::vector<std::unique_ptr<FlowMethod>> methods;
    for (const std::string& name : names)
        methods.push_back(factory.create(name, run.set().rig));
    run.each(
        [&](const Shot& still) {
            for (const auto& method : methods)
                method->setStill(still);
        },
        [&](const FlowSample& sample, const Shot& frame) {
            const cv::Mat truth = loadTruth(run.set(), sample);
            for (std::size_t i = 0; i < methods.size(); ++i)
                addRow(report, run.label(), sample, names[i], methods[i]->run(frame), truth);
        });
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
    FlowFactory factory;
    const auto labels = labelsOf(request.folders);
    for (std::size_t i = 0; i < labels.size(); ++i)
        measure(
            SampleRun(request, request.folders[i], labels[i], flowSamplesOf(request.folders[i])),
            request.methods, factory, report);
    report.addMeans();
    return report;
}

}  // namespace mfar::eval
