#include "base/svg.h"
#include "tests/measure/bench/pareto.h"
#include "tests/measure/eval/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mfar::bench {
namespace {

namespace draw = svg;

constexpr double kWide = 520, kHigh = 400, kMarginLeft = 80, kMarginTop = 60, kBetween = 90,
                 kMarginBelow = 60;
// Smaller errors are drawn at this value, because 0 has no logarithm.
constexpr double kLeastError = 1e-3;

bool canBeDrawn(const ParetoPoint& p) {
    return std::isfinite(p.ms) && std::isfinite(p.error) && p.ms > 0 && p.error >= 0;
}

class StagePanel {
public:
    StagePanel(const ParetoStage& stage, double left) : stage_(stage), left_(left) {
        for (const ParetoPoint& p : stage.points) {
            if (!canBeDrawn(p)) continue;
            time_.include(p.ms);
            error_.include(std::max(p.error, kLeastError));
        }
    }

    [[nodiscard]] std::string svg() const {
        std::string out = grid() + front();
        for (const ParetoPoint& p : stage_.points)
            if (canBeDrawn(p)) out += mark(p);
        return out;
    }

private:
    [[nodiscard]] double x(double ms) const { return left_ + kWide * time_.at(ms); }
    [[nodiscard]] double y(double error) const {
        return kMarginTop + kHigh * (1 - error_.at(std::max(error, kLeastError)));
    }

    [[nodiscard]] std::string grid() const {
        std::string out = draw::text(left_ + kWide / 2, kMarginTop - 14, "middle",
                                     stage_.name + ": " + stage_.samples, 14);
        for (const double ms : time_.ticks())
            out += draw::line(x(ms), kMarginTop, x(ms), kMarginTop + kHigh) +
                   draw::text(x(ms), kMarginTop + kHigh + 16, "middle", fmt::format("{:g}", ms));
        for (const double error : error_.ticks())
            out += draw::line(left_, y(error), left_ + kWide, y(error)) +
                   draw::text(left_ - 6, y(error) + 4, "end", fmt::format("{:g}", error));
        return out +
               draw::text(left_ + kWide / 2, kMarginTop + kHigh + 36, "middle",
                          "median time [ms], logarithmic") +
               draw::textUpwards(left_ - 48, kMarginTop + kHigh / 2,
                                 stage_.measure + ", logarithmic");
    }

    [[nodiscard]] std::string front() const {
        std::string path, names;
        for (const std::size_t i : paretoFront(stage_.points)) {
            const ParetoPoint& p = stage_.points[i];
            if (!canBeDrawn(p)) continue;
            path += path.empty() ? fmt::format("M{:.1f} {:.1f}", x(p.ms), y(p.error))
                                 : fmt::format(" H{:.1f} V{:.1f}", x(p.ms), y(p.error));
            if (p.kind != ParetoPoint::Kind::Peer)
                names += draw::text(x(p.ms) + 8, y(p.error) - 6, "start", p.name, 10);
        }
        if (path.empty()) return "";
        return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                           path, draw::kColours[1]) +
               names;
    }

    [[nodiscard]] std::string mark(const ParetoPoint& p) const {
        const std::string title = fmt::format("<title>{}: {:.1f} ms, {:.4g}</title>",
                                              draw::escaped(p.name), p.ms, p.error);
        if (p.kind == ParetoPoint::Kind::Peer)
            return fmt::format("<path d=\"M{:.1f} {:.1f} l6 6 l-6 6 l-6 -6 z\" "
                               "fill=\"#000\">{}</path>\n",
                               x(p.ms), y(p.error) - 6, title) +
                   draw::text(x(p.ms) + 9, y(p.error) + 14, "start", p.name, 10);
        std::string out = fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" "
                                      "fill=\"{}\">{}</circle>\n",
                                      x(p.ms), y(p.error), draw::kColours[0], title);
        if (p.kind == ParetoPoint::Kind::Default)
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" fill=\"none\" "
                               "stroke=\"#000\" stroke-width=\"1.5\"/>\n",
                               x(p.ms), y(p.error));
        return out;
    }

    const ParetoStage& stage_;
    double left_;
    eval::LogAxis time_, error_;
};

}  // namespace

std::string paretoSvg(const std::vector<ParetoStage>& stages) {
    std::string body;
    double left = kMarginLeft;
    for (const ParetoStage& stage : stages) {
        body += StagePanel(stage, left).svg();
        left += kWide + kBetween;
    }
    body += draw::text(kMarginLeft, 24, "start",
                       "Run time against error. Discs: mfar (ring: default). Diamonds: other "
                       "methods. Line: undominated points.",
                       16);
    return draw::document(left, kMarginTop + kHigh + kMarginBelow, body);
}

}  // namespace mfar::bench
