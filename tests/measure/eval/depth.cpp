#include "tests/measure/eval/depth.h"

#include "hal/virtual/image_files.h"
#include "tests/measure/eval/depth_methods.h"
#include "tests/measure/eval/metrics/depth_error.h"
#include "tests/measure/eval/sample_table.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

namespace mfar::eval {
namespace {

constexpr double kEdgeReach = 4;  // pixels up to this distance count as near a depth edge [px]

struct DepthTruth {
    cv::Mat visible;  ///< inverse depth, CV_32F [1/m]; NaN: unknown, or occluded in the still
    cv::Mat all, edges, inner;
    double disparity;  ///< disparity of a point at a depth of 1 m [px]
};

DepthTruth loadDepthTruth(const FlowSet& set, const FlowSample& sample) {
    const cv::Mat flow = loadTruth(set, sample);
    FloatImage image = loadPfm(sample.truth);
    const cv::Mat inverseDepth(flow.size(), CV_32F, image.values.data());
    DepthTruth out;
    out.visible = inverseDepth.clone();
    for (int y = 0; y < flow.rows; ++y)
        for (int x = 0; x < flow.cols; ++x)
            if (std::isnan(flow.at<cv::Vec2f>(y, x)[0]))
                out.visible.at<float>(y, x) = std::numeric_limits<float>::quiet_NaN();
    out.all = cv::Mat(flow.size(), CV_8U, cv::Scalar(255));
    out.edges = nearDepthEdge(inverseDepth, kEdgeReach);
    out.inner = ~out.edges;
    const RigidTransform T_still_frame =
        stillFromFrame(set.rig, *sample.poses.frame, *sample.poses.still);
    out.disparity = set.rig.video.fx * T_still_frame.translation.norm();
    return out;
}

void addRow(Report& report, const SampleRow& row, const DepthMethod::Result& result,
            const DepthTruth& truth) {
    const auto within = [&](const cv::Mat& mask) {
        return depthError(result.inverseDepth, truth.visible, truth.disparity, mask);
    };
    const DepthError all = within(truth.all), edge = within(truth.edges),
                     inner = within(truth.inner);
    if (all.pixels == 0)
        throw EvalError(fmt::format("{}: the ground truth has no pixel with a known depth",
                                    row.sample.truth.string()));
    const auto measured = [](double value) {
        return std::isnan(value) ? std::nullopt : std::optional(value);
    };
    Sparsification sparse{{}, {}, NAN, NAN};
    if (!result.variance.empty())
        sparse = depthSparsification(result.inverseDepth, result.variance, truth.visible,
                                     truth.disparity);
    report.add(row.label, row.sample.frame, row.method,
               {all.completeness > 0 ? std::optional(result.ms) : std::nullopt,
                measured(all.absrel), all.bad1, all.completeness, measured(edge.absrel),
                measured(edge.bad1), measured(inner.absrel), measured(inner.bad1), all.delta[0],
                all.delta[1], all.delta[2], measured(sparse.ause), measured(sparse.ausePerRandom)});
}

}  // namespace

Report evaluateDepth(const SampleRequest& request) {
    Report report({{"ms", 1},
                   {"absrel", 4},
                   {"bad1", 4},
                   {"completeness", 4},
                   {"edge_absrel", 4},
                   {"edge_bad1", 4},
                   {"inner_absrel", 4},
                   {"inner_bad1", 4},
                   {"delta1", 4},
                   {"delta2", 4},
                   {"delta3", 4},
                   {"ause", 4},
                   {"ause_rel", 3}});
    measureSamples<DepthFactory>(
        request, depthSamplesOf, loadDepthTruth,
        [&report](const SampleRow& row, const auto& result, const auto& truth) {
            addRow(report, row, result, truth);
        },
        report);
    return report;
}

}  // namespace mfar::eval
