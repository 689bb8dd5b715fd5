#include "tests/measure/bench/curve_report.h"
#include "tests/measure/eval/plot.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace mfar::bench {
namespace {

eval::PlotPoint plotted(const CurvePoint& p) {
    const double percent = p.ms > 0 ? 100 * p.bad1 : std::numeric_limits<double>::quiet_NaN();
    return {p.ms, percent, {}, {}};
}

eval::PlotLine plotted(const Curve& curve) {
    eval::PlotLine out;
    std::string values;
    for (const CurvePoint& p : curve.points) {
        eval::PlotPoint& at = out.points.emplace_back(plotted(p));
        at.tip = fmt::format("{} {:g}: {:.1f} ms, {:.2f} %", curve.knob, p.value, p.ms, at.y);
        const bool isEnd = &p == &curve.points.front() || &p == &curve.points.back();
        if (isEnd && !p.isDefault) at.label = fmt::format("{:g}", p.value);
        if (!std::isfinite(at.y)) continue;
        values += fmt::format("{}{:g}{}", values.empty() ? "" : ", ", p.value,
                              p.isDefault ? " (default)" : "");
    }
    out.legend = fmt::format("{}: {}", curve.knob, values);
    return out;
}

eval::PlotPanel panelOf(const Curves& curves, std::string_view method, const char* title) {
    eval::PlotPanel out{
        title, "time of the flow [ms]", "bad-1: pixels off by more than 1 px [%]", 0.01, {}, {},
        {}};
    for (const Curve& curve : curves.curves) {
        if (curve.method != method) continue;
        out.lines.push_back(plotted(curve));
        for (const CurvePoint& p : curve.points)
            if (p.isDefault) {
                out.ringed = plotted(p);
                out.ringed->label = "default";
            }
    }
    for (const CurvePeer& peer : curves.peers)
        out.diamonds.emplace_back(plotted(peer.point)).label = peer.name;
    return out;
}

}  // namespace

std::string curvesSvg(const Curves& curves) {
    std::vector<eval::PlotPanel> panels;
    for (const auto& [method, title] : std::array<std::pair<const char*, const char*>, 2>{
             {{"flow2d", "2-D flow, both directions"},
              {"epipolar", "search along epipolar lines"}}}) {
        eval::PlotPanel panel = panelOf(curves, method, title);
        if (!panel.lines.empty()) panels.push_back(std::move(panel));
    }
    return eval::plotSvg("Time against error of the flow, one option varied at a time", panels,
                         fmt::format("Diamonds: OpenCV's flow in one direction. Samples: {}",
                                     fmt::join(curves.samples, ", ")));
}

}  // namespace mfar::bench
