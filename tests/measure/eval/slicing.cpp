#include "tests/measure/eval/slicing.h"

#include "tests/measure/eval/plot.h"
#include "tests/measure/eval/sliced_rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace mfar::eval {
namespace {

constexpr const char* kSceneName = "still-life";
// The paper traces one picture over this many frames.
constexpr int kFramesOfPicture = 64;
// Turn of the camera [degrees/s]. It is so fast that a new picture is needed every few seconds, so
// starts and ends of pictures are measured too.
constexpr double kTurnPerSecond = 3;

struct SlicingMethod {
    const char* name;
    Slicing slicing;
    bool adaptive;
};
constexpr SlicingMethod kSlicingMethods[] = {{"time", Slicing::Time, false},
                                             {"spatial", Slicing::Spatial, false},
                                             {"time-adaptive", Slicing::Time, true},
                                             {"spatial-adaptive", Slicing::Spatial, true}};

SliceOptions slicesOf(const SlicingMethod& method, int samples, int samplesPerTurn) {
    SliceOptions out;
    out.slicing = method.slicing;
    out.samples = samples;
    out.samplesPerTurn = samplesPerTurn;
    if (!method.adaptive) out.threshold = 0;
    return out;
}

void addErrors(Report& report, const char* method, const std::vector<ErrorAt>& errors,
               PlotPanel& panel) {
    PlotLine line{method, {}};
    for (const ErrorAt& e : errors) {
        report.add(kSceneName, fmt::format("{:.4g}", e.samples), method,
                   {e.ms, e.rmse, e.filtered, {}, {}, {}, {}, {}});
        line.points.push_back({e.ms,
                               e.rmse,
                               fmt::format("{}, {:.4g} samples per pixel: {:.0f} ms, error {:.2f} "
                                           "grey levels (RMS)",
                                           method, e.samples, e.ms, e.rmse),
                               {}});
    }
    panel.lines.push_back(std::move(line));
}

void addFrames(Report& report, const char* method, std::vector<double> ms) {
    const auto count = static_cast<double>(ms.size());
    const double mean = std::accumulate(ms.begin(), ms.end(), 0.0) / count;
    double squares = 0;
    for (const double v : ms)
        squares += (v - mean) * (v - mean);
    std::ranges::sort(ms);
    const double p95 = ms[ms.size() * 95 / 100];
    report.add(
        kSceneName, "frames", method,
        {mean, {}, {}, std::sqrt(squares / count) / mean, p95 / mean, ms.back() / mean, {}, {}});
}

std::vector<Column> columns() {
    return {{"ms", 2},        {"rmse", 3},      {"rmse_filtered", 3}, {"frame_cv", 3},
            {"frame_p95", 3}, {"frame_max", 3}, {"budget_mean", 3},   {"budget_p95_off", 3}};
}

void writePlot(const SlicingRequest& request, const PlotPanel& panel) {
    if (request.svg.empty()) return;
    writeText(request.svg,
              plotSvg("Error against time of slices and of full renderings", {panel},
                      fmt::format("{}x{}, one thread; truth: {} samples of another seed",
                                  request.size.width, request.size.height, request.truthSamples)));
}

}  // namespace

Report evaluateSlicing(const SlicingRequest& request) {
    Report report(columns());
    // Ten progress steps: the truth; error against time of four methods and of a full rendering;
    // frame times of two methods; use of the budget by two methods.
    constexpr std::size_t kSteps = 10;
    std::size_t step = 0;
    const auto next = [&](const char* what, const char* method) {
        request.progress.show(step++, kSteps, fmt::format("{} {}", what, method));
    };
    next("tracing", "the true picture");
    const SlicedScene scene(request.size, request.truthSamples, request.threads);
    PlotPanel panel;
    panel.title = "balls and boxes with sun and environment";
    panel.xLabel = "processor time [ms]";
    panel.yLabel = "RMSE [grey levels]";
    for (const SlicingMethod& method : kSlicingMethods) {
        next("error of method", method.name);
        addErrors(report, method.name, slicedErrors(scene, slicesOf(method, request.samples, 1)),
                  panel);
    }
    next("error of method", "full");
    addErrors(report, "full", wholeErrors(scene, request.samples), panel);
    for (const SlicingMethod& method : kSlicingMethods) {
        if (method.adaptive) continue;
        next("frame times of method", method.name);
        addFrames(report, method.name,
                  frameTimes(scene, slicesOf(method, request.samples, 1), kFramesOfPicture));
    }
    for (const SlicingMethod& method : kSlicingMethods) {
        if (method.adaptive) continue;
        next("use of the budget by method", method.name);
        const BudgetRun run =
            budgetRun(slicesOf(method, request.samples, 2), request.size, request.budgetMs,
                      request.threads, request.frames, kTurnPerSecond);
        report.add(kSceneName, "budget", method.name,
                   {run.mean * request.budgetMs, {}, {}, {}, {}, {}, run.mean, run.deviation});
    }
    writePlot(request, panel);
    return report;
}

}  // namespace mfar::eval
