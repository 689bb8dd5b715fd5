#include "tests/eval/flow.h"

#include "tests/eval/flow_methods.h"
#include "tests/eval/flow_samples.h"
#include "tests/eval/labels.h"
#include "tests/eval/metrics/flow_error.h"
#include "tests/eval/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace mfar::eval {
namespace {

double medianMs(const FlowMethod& method, const FlowPictures& pictures) {
    std::array<double, 3> ms{};
    for (double& value : ms)
        value = wallMs([&] { (void)method(pictures.a, pictures.b); });
    std::sort(ms.begin(), ms.end());
    return ms[1];
}

}  // namespace

Report evaluateFlow(const FlowRequest& request) {
    Report report({{"ms", 1}, {"epe_px", 3}, {"bad1", 4}, {"bad2", 4}, {"coverage", 4}});
    FlowFactory factory;
    std::vector<FlowMethod> methods;
    methods.reserve(request.methods.size());
    for (const std::string& name : request.methods)
        methods.push_back(factory.create(name));
    const auto labels = labelsOf(request.folders);
    for (std::size_t i = 0; i < labels.size(); ++i) {
        auto samples = flowSamplesOf(request.folders[i]);
        if (request.frames > 0 && samples.size() > static_cast<std::size_t>(request.frames))
            samples.resize(static_cast<std::size_t>(request.frames));
        for (const FlowSample& sample : samples) {
            const FlowPictures pictures = loadFlowPictures(sample);
            for (std::size_t m = 0; m < methods.size(); ++m) {
                const cv::Mat flow = methods[m](pictures.a, pictures.b);
                const FlowError error = flowError(flow, pictures.truth);
                if (error.known == 0)
                    throw EvalError(fmt::format("{}: no vector is known", sample.truth.string()));
                report.add(labels[i], sample.frame, request.methods[m],
                           {medianMs(methods[m], pictures), error.epe, error.bad1, error.bad2,
                            error.coverage});
            }
        }
    }
    report.addMeans();
    return report;
}

}  // namespace mfar::eval
