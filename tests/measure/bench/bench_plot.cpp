#include "base/line_chart.h"
#include "tests/measure/bench/bench_report.h"
#include "tests/measure/bench/governor_run.h"
#include "tests/measure/bench/skips.h"
#include "tests/measure/eval/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mfar::bench {
namespace {

eval::Bar bar(const std::string& label, const Summary& of, std::size_t colour) {
    return {label, of.runs > 0 ? of.median : std::nan(""), {of.min, of.p99}, colour};
}

eval::BarPanel framePanel(const BenchResult& result) {
    eval::BarPanel out{"whole frame [ms]", {}, 1};
    for (std::size_t i = 0; i < result.cases.size(); ++i) {
        const CaseResult& one = result.cases[i];
        out.bars.push_back(bar(one.name, one.frame, 0));
        for (const PeerResult& peer : result.peers)
            if (peer.of == one.name)
                out.bars.push_back(bar(fmt::format("{}, {}", one.name, peer.name), peer.frame, 1));
    }
    return out;
}

}  // namespace

std::string benchSvg(const BenchResult& result) {
    std::vector<eval::BarPanel> panels{framePanel(result)};
    for (const CaseResult& one : result.cases) {
        eval::BarPanel& panel =
            panels.emplace_back(eval::BarPanel{one.name + ", stages [ms]", {}, 2});
        for (const StageSummary& stage : one.stages)
            panel.bars.push_back(bar(stage.stage, stage.ms, 2));
    }
    panels.push_back(
        {"other work [ms]",
         {bar("new still", result.setStill, 3),
          bar("depth, 1/10 of picture", result.depth.tenth, 3),
          bar("depth, whole picture", result.depth.whole, 3),
          bar("warp, small objects", result.warp.objects, 3),
          bar("warp, whole picture", result.warp.whole, 3), bar("cv::remap", result.warp.remap, 1)},
         2});
    return eval::barsSvg(
        "mfar-bench: " + result.renderer, panels,
        "Bars are medians. One small circle marks the fastest run, the other the time "
        "that 99 % of the runs do not exceed. Orange bars are OpenCV's.");
}

std::string skipSvg(const SkipReport& report) {
    std::vector<eval::BarPanel> panels;
    for (const SkipCase& one : report.cases) {
        eval::BarPanel saved{one.scene + ": saved [ms]", {}, 2},
            lost{one.scene + ": PSNR lost [dB]", {}, 3};
        for (const SkipResult& skip : report.results) {
            if (skip.scene != one.scene) continue;
            saved.bars.push_back({skip.skip, skip.msWithout - skip.ms, {}, 2});
            lost.bars.push_back({skip.skip, skip.psnrLost.value_or(std::nan("")), {}, 1});
        }
        panels.push_back(std::move(saved));
        panels.push_back(std::move(lost));
    }
    return eval::barsSvg("mfar-bench skip: time saved and quality lost by skipping work", panels,
                         "");
}

std::string governorSvg(std::span<const GovernedRun> runs) {
    constexpr double kWidth = 460, kHeight = 210;
    std::vector<eval::SizedSvg> parts;
    for (const GovernedRun& run : runs) {
        std::size_t frames = 0;
        for (const GovernedScene& scene : run.scenes)
            frames += scene.ms.size();
        LineChart chart{fmt::format("deadline {:g} ms: time of each frame [ms]", run.deadlineMs),
                        "frame",
                        {},
                        {},
                        false,
                        {},
                        ChartLine{"deadline", {run.deadlineMs}}};
        for (std::size_t i = 0; i < frames; ++i)
            chart.x.push_back(static_cast<double>(i));
        std::size_t begin = 0;
        for (const GovernedScene& scene : run.scenes) {
            ChartLine line{scene.name, std::vector<double>(frames, std::nan(""))};
            std::ranges::copy(scene.ms, line.y.begin() + static_cast<std::ptrdiff_t>(begin));
            begin += scene.ms.size();
            chart.lines.push_back(std::move(line));
        }
        parts.push_back({chartSvg(chart), kWidth, kHeight});
    }
    return eval::gridSvg("mfar-bench governor", parts, 1, "");
}

}  // namespace mfar::bench
