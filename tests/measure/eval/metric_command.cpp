#include "tests/measure/eval/metric_command.h"

#include "daemon/output_checks.h"
#include "tests/measure/eval/metrics/luma.h"
#include "tests/measure/eval/picture.h"
#include "tests/measure/eval/picture_metrics_option.h"

#include <fmt/format.h>

#include <utility>

namespace mfar::eval {
namespace {

/// Sets the HDR-VDP-2 scores in `out` to those of the colours on an sRGB display.
void scoreColours(const cv::Mat& test, const cv::Mat& reference, const HdrVdpDisplay& display,
                  PictureScores& out) {
    const auto light = [&](const cv::Mat& picture) {
        cv::Mat levels;
        picture.convertTo(levels, CV_64F);
        return displayedLight(levels, display);
    };
    const HdrVdpResult result = hdrVdp(light(test), light(reference), display.pixelsPerDegree);
    out.hdrVdpQ = result.q;
    out.hdrVdpQMos = result.qMos;
}

}  // namespace

CLI::App* addMetricCommand(CLI::App& app, MetricRequest& request, std::string& csv) {
    CLI::App* sub = app.add_subcommand("metric", "compare two pictures of the same size");
    sub->footer(std::string("Values are those of luma (Rec. 601) of the whole pictures. ") +
                kPictureMetricsHelp);
    sub->add_option("test", request.test, "picture to score, PNG or JPEG")->required();
    sub->add_option("reference", request.reference, "true picture, PNG or JPEG")->required();
    addPictureMetrics(*sub, request.metrics);
    sub->add_flag("--colour", request.colour,
                  "compute hdrvdp from colours on an sRGB display (LCD with fluorescent light) "
                  "instead of luma; --gamma has no effect then");
    sub->add_option("--csv", csv, "file to write the table into")->check(fileToWrite());
    return sub;
}

Report evaluateMetric(const MetricRequest& request) {
    const cv::Mat test = loadPicture(request.test), reference = loadPicture(request.reference);
    if (test.size() != reference.size())
        throw EvalError(fmt::format("{} has {}x{} pixels, but {} has {}x{}", request.test.string(),
                                    test.cols, test.rows, request.reference.string(),
                                    reference.cols, reference.rows));
    request.progress.show(0, 1, "metrics of " + request.test.filename().string());
    PictureMetrics metrics = request.metrics;
    const bool colours = request.colour && metrics.has("hdrvdp");
    if (colours) std::erase(metrics.names, "hdrvdp");
    PictureScores scores = scoreOf(luma(test), luma(reference), metrics);
    if (colours) scoreColours(test, reference, metrics.display, scores);
    auto further = furtherValues(scores, request.metrics);
    if (colours) further.back().reset();  // hdrvdp_gamma: sRGB has no single gamma value
    Report report(followedBy<Column>({{"psnr_db", 2}, {"ssim", 4}, {"lpc_si", 4}, {"hdrvdp_q", 2}},
                                     furtherColumns(request.metrics)));
    report.add(request.reference.filename().string(), request.test.filename().string(),
               colours ? "colour" : "luma",
               followedBy({scores.psnr, scores.ssim, scores.lpcSi, scores.hdrVdpQ}, further));
    return report;
}

}  // namespace mfar::eval
