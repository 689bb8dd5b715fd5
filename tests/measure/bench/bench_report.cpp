#include "tests/measure/bench/bench_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

namespace mfar::bench {
namespace {

constexpr std::array<const char*, kTileClasses> kClassNames{"unchanged", "enlarged", "trusted",
                                                            "blended"};

nlohmann::json json(const Summary& s) {
    return {{"median_ms", s.median}, {"p99_ms", s.p99}, {"min_ms", s.min}, {"runs", s.runs}};
}

nlohmann::json json(Size size) {
    return {size.width, size.height};
}

nlohmann::json json(const CaseResult& result) {
    nlohmann::json stages = nlohmann::json::array(), tiles = nlohmann::json::object();
    for (const StageSummary& stage : result.stages) {
        stages.push_back(json(stage.ms));
        stages.back()["stage"] = stage.stage;
    }
    for (std::size_t c = 0; c < kTileClasses; ++c)
        tiles[kClassNames[c]] = result.tileShare[c];
    return {{"name", result.name},
            {"frame", json(result.frame)},
            {"stages", stages},
            {"tile_share", tiles}};
}

nlohmann::json json(const WarpTimes& t) {
    return {{"objects", json(t.objects)},
            {"whole", json(t.whole)},
            {"still", json(t.still)},
            {"new_picture", json(t.newPicture)},
            {"remap", json(t.remap)}};
}

nlohmann::json json(const ObjectTimes& t) {
    return {{"tracing", json(t.tracing)}, {"waiting", json(t.waiting)}};
}

std::string line(const std::string& name, const Summary& s) {
    return fmt::format("{:<28} {:>9.2f} {:>9.2f} {:>9.2f} {:>6}", name, s.median, s.p99, s.min,
                       s.runs);
}

std::string tileLine(const CaseResult& result) {
    std::string out = "  tiles:";
    for (std::size_t c = 0; c < kTileClasses; ++c)
        if (result.tileShare[c] > 0)
            out += fmt::format(" {} {:.1f} %", kClassNames[c], 100 * result.tileShare[c]);
    return out;
}

nlohmann::json json(const RenderFigures& render) {
    nlohmann::json rates = nlohmann::json::array(), errors = nlohmann::json::array();
    for (const RayRates& r : render.rates)
        rates.push_back({{"triangles", r.triangles},
                         {"embree_mray_s", r.bare},
                         {"camera_mray_s", r.ours},
                         {"share", r.ours / r.bare},
                         {"msample_s", r.samples}});
    for (const SamplingError& e : render.errors)
        errors.push_back({{"scene", e.scene},
                          {"rmse", e.ours},
                          {"rmse_independent", e.independent},
                          {"ratio", e.independent / e.ours}});
    return {{"rates", rates}, {"errors_at_16_samples", errors}};
}

std::string toTable(const RenderFigures& render) {
    std::string out;
    for (const RayRates& r : render.rates)
        out += fmt::format("one thread, {:>6} triangles [million/s]: single rays of plain Embree "
                           "{:.2f}, camera rays of mfar in packets {:.2f} ({:.0f} % of "
                           "plain Embree's), paths of mfar {:.2f}\n",
                           r.triangles, r.bare, r.ours, 100 * r.ours / r.bare, r.samples);
    for (const SamplingError& e : render.errors)
        out += fmt::format("RMSE of radiance at 16 samples per pixel, {:<36} mfar {:.5f}, "
                           "independent random samples {:.5f} = {:.1f} times mfar's\n",
                           e.scene + ":", e.ours, e.independent, e.independent / e.ours);
    return out;
}

std::string toTable(const WarpTimes& warp, const ObjectTimes& objects) {
    std::string out = line("warp, objects", warp.objects) + '\n' +
                      line("warp, whole picture", warp.whole) + '\n' +
                      line("warp, camera at rest", warp.still) + '\n' +
                      line("warp, new picture", warp.newPicture) + '\n' +
                      line("peer cv::remap", warp.remap) + '\n';
    if (objects.tracing.runs > 0)
        out += line("objects, path tracer works", objects.tracing) +
               fmt::format("  {:.1f} % more than while it waits\n",
                           100 * (objects.tracing.median / objects.waiting.median - 1)) +
               line("objects, path tracer waits", objects.waiting) + '\n';
    return out;
}

}  // namespace

nlohmann::json toJson(const BenchResult& result) {
    nlohmann::json cases = nlohmann::json::array(), peers = nlohmann::json::array(),
                   scaling = nlohmann::json::array();
    for (const CaseResult& c : result.cases)
        cases.push_back(json(c));
    for (const PeerResult& peer : result.peers)
        peers.push_back({{"name", peer.name},
                         {"case", peer.of},
                         {"frame", json(peer.frame)},
                         {"ratio", peer.ratio},
                         {"ratio_p10", peer.low},
                         {"ratio_p90", peer.high}});
    for (const ScalingResult& s : result.scaling) {
        nlohmann::json one = {
            {"threads", s.threads}, {"output", json(s.output)}, {"moving", json(s.moving)}};
        if (s.handheld.runs > 0) one["handheld"] = json(s.handheld);
        scaling.push_back(std::move(one));
    }
    return {{"workload", result.workload},
            {"posed", result.posed},
            {"renderer", result.renderer},
            {"opencv", CV_VERSION},
            {"opencv_threads", cv::getNumThreads()},
            {"video", json(result.video)},
            {"still", json(result.still)},
            {"output", json(result.output)},
            {"set_still", json(result.setStill)},
            {"cases", cases},
            {"peers", peers},
            {"depth", {{"tenth", json(result.depth.tenth)}, {"whole", json(result.depth.whole)}}},
            {"warp", json(result.warp)},
            {"objects", json(result.objects)},
            {"triangulation_ns_per_point",
             {{"flow", result.triangulation.flow},
              {"midpoint", result.triangulation.midpoint},
              {"opencv", result.triangulation.opencv}}},
            {"scaling", scaling},
            {"render", json(result.render)}};
}

std::string toTable(const BenchResult& result) {
    std::string out =
        fmt::format("{}\nworkload {}; with poses {}; video {}x{}, still {}x{}, output {}x{}\n\n",
                    result.renderer, result.workload, result.posed.empty() ? "none" : result.posed,
                    result.video.width, result.video.height, result.still.width,
                    result.still.height, result.output.width, result.output.height);
    out += fmt::format("{:<28} {:>9} {:>9} {:>9} {:>6}\n", "time [ms]", "median", "p99", "min",
                       "runs");
    out += line("new still", result.setStill) + '\n';
    for (const CaseResult& c : result.cases) {
        out += line(c.name, c.frame) + tileLine(c) + '\n';
        for (const StageSummary& stage : c.stages)
            out += line("  " + stage.stage, stage.ms) + '\n';
    }
    for (const PeerResult& peer : result.peers)
        out += line("peer " + peer.name, peer.frame) +
               fmt::format("  mfar (case {}) takes {:.2f} of this time; ratios of single frames: "
                           "{:.2f} (10th percentile) to {:.2f} (90th)\n",
                           peer.of, peer.ratio, peer.low, peer.high);
    for (const ScalingResult& s : result.scaling)
        out += fmt::format(
            "{} thread{}, output {:>4}x{:<4}  frame time: moving {:>7.2f} ms{}\n", s.threads,
            s.threads == 1 ? " " : "s", s.output.width, s.output.height, s.moving.median,
            s.handheld.runs > 0 ? fmt::format("  handheld {:>7.2f} ms", s.handheld.median) : "");
    if (result.depth.whole.runs > 0)
        out += line("depth, tenth of the picture", result.depth.tenth) + '\n' +
               line("depth, whole picture", result.depth.whole) + '\n';
    out += toTable(result.warp, result.objects);
    const TriangulationTimes& t = result.triangulation;
    out +=
        fmt::format("triangulation of flow [ns per point], which mfard does not need: closed form "
                    "{:.1f}, midpoint {:.1f}, cv::triangulatePoints {:.0f} ({:.0f} times as "
                    "long as the closed form)\n",
                    t.flow, t.midpoint, t.opencv, t.opencv / t.flow);
    return out + toTable(result.render);
}

}  // namespace mfar::bench
