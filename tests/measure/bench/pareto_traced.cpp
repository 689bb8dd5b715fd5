#include "tests/measure/bench/pareto_stages.h"
#include "tests/measure/eval/slicing.h"
#include "tests/measure/eval/warp.h"
#include "tests/measure/eval/warp_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>

namespace mfar::bench {
namespace {

using Kind = ParetoPoint::Kind;

constexpr const char* kDefaultFilling = "both";
constexpr const char* kDefaultSlicing = "time-adaptive";
constexpr const char* kWholePicture = "full";
constexpr const char* kInpainting = "inpaint";

double valueOf(const eval::Report::Row& row, std::size_t column) {
    return row.values.at(column).value();
}

struct Sum {
    double ms = 0, error = 0;
    int scenes = 0;
};

bool isPeer(const std::string& method) {
    return method == kWholePicture || method == kInpainting;
}

}  // namespace

ParetoStage warpStage(bool quick) {
    eval::WarpRequest request;
    request.degrees = {10};
    request.scenes = eval::warpSceneNames();
    request.methods = eval::warpMethodNames();
    if (quick) {
        request.size = {96, 72};
        request.scenes.pop_back();
        request.referenceSamples = 8;
        request.truthSamples = 32;
    }
    std::map<std::string, Sum> sums;
    const eval::Report report = eval::evaluateWarp(request);
    for (const auto& row : report.rows()) {
        Sum& sum = sums[row.method];
        sum.error += 255 * std::pow(10, -valueOf(row, 0) / 20);
        sum.ms += valueOf(row, row.values.size() - 1);
        ++sum.scenes;
    }
    sums.at(kInpainting).ms += sums.at("none").ms;
    ParetoStage out{"warp of a path-traced picture",
                    "RMSE inside the silhouette [grey levels]",
                    fmt::format("{}, turned by 10 degrees, {}x{}, wall clock, "
                                "without the time of re-rendered pixels",
                                fmt::join(request.scenes, " and "), request.size.width,
                                request.size.height),
                    {}};
    for (const std::string& method : request.methods) {
        const Sum& sum = sums.at(method);
        const Kind own = method == kDefaultFilling ? Kind::Default : Kind::Ours;
        out.points.push_back({method, isPeer(method) ? Kind::Peer : own, sum.ms / sum.scenes,
                              sum.error / sum.scenes});
    }
    return out;
}

ParetoStage slicingStage(bool quick) {
    eval::SlicingRequest request;
    request.frames = 8;  // only the rows `budget`, which are not used below, need more
    if (quick) {
        request.size = {48, 36};
        request.samples = 8;
        request.truthSamples = 16;
    }
    ParetoStage out{"slicing",
                    "RMSE [grey levels]",
                    fmt::format("balls and boxes, {}x{}, processor time of one thread",
                                request.size.width, request.size.height),
                    {}};
    std::size_t last = 0;
    const eval::Report report = eval::evaluateSlicing(request);
    for (const auto& row : report.rows()) {
        if (row.values.size() < 2 || !row.values[1]) continue;
        const Kind kind = row.method == kWholePicture ? Kind::Peer : Kind::Ours;
        if (row.method == kDefaultSlicing) last = out.points.size();
        out.points.push_back({fmt::format("{} with {} samples", row.method, row.frame), kind,
                              valueOf(row, 0), valueOf(row, 1)});
    }
    if (last < out.points.size()) out.points[last].kind = Kind::Default;
    return out;
}

}  // namespace mfar::bench
