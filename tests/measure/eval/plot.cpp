#include "tests/measure/eval/plot.h"

#include "base/svg.h"
#include "tests/measure/eval/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mfar::eval {
namespace {

constexpr int kPanelWidth = 470, kPanelHeight = 380, kLeft = 70, kTop = 70, kGap = 70;
constexpr int kLegendLine = 20, kBelow = 64;

bool isPlottable(const PlotPoint& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y >= 0;
}

class DrawnPanel {
public:
    DrawnPanel(const PlotPanel& panel, double left) : panel_(panel), left_(left) {
        const auto include = [&](const PlotPoint& p) {
            if (!isPlottable(p)) return;
            across_.include(p.x);
            upwards_.include(std::max(p.y, panel.leastY));
        };
        for (const PlotLine& line : panel.lines)
            for (const PlotPoint& p : line.points)
                include(p);
        for (const PlotPoint& p : panel.diamonds)
            include(p);
    }

    [[nodiscard]] std::string drawn() const {
        std::string out =
            svg::text(left_ + kPanelWidth / 2.0, kTop - 12, "middle", panel_.title, 15);
        out += axes();
        for (std::size_t i = 0; i < panel_.lines.size(); ++i)
            out += line(panel_.lines[i], svg::kColours[i % svg::kColours.size()], legendAt(i));
        for (const PlotPoint& p : panel_.diamonds)
            out += diamond(p);
        if (panel_.ringed && isPlottable(*panel_.ringed))
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\" fill=\"none\" "
                               "stroke=\"#000\" stroke-width=\"1.5\"/>\n",
                               x(*panel_.ringed), y(*panel_.ringed)) +
                   svg::text(x(*panel_.ringed) - 11, y(*panel_.ringed) + 16, "end",
                             panel_.ringed->label);
        return out;
    }
    static double legendAt(std::size_t line) {
        return kTop + kPanelHeight + kBelow + static_cast<double>(line) * kLegendLine;
    }

private:
    [[nodiscard]] double x(const PlotPoint& p) const {
        return left_ + kPanelWidth * across_.at(p.x);
    }
    [[nodiscard]] double yOf(double value) const {
        return kTop + kPanelHeight * (1 - upwards_.at(value));
    }
    [[nodiscard]] double y(const PlotPoint& p) const { return yOf(std::max(p.y, panel_.leastY)); }

    [[nodiscard]] std::string axes() const {
        std::string out;
        for (const double value : upwards_.ticks()) {
            out += svg::line(left_, yOf(value), left_ + kPanelWidth, yOf(value));
            out += svg::text(left_ - 6, yOf(value) + 4, "end", fmt::format("{:g}", value));
        }
        for (const double value : across_.ticks()) {
            const double at = left_ + kPanelWidth * across_.at(value);
            out += svg::line(at, kTop, at, kTop + kPanelHeight);
            out += svg::text(at, kTop + kPanelHeight + 16, "middle", fmt::format("{:g}", value));
        }
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                           "stroke=\"#888\"/>\n",
                           left_, kTop, kPanelWidth, kPanelHeight);
        out += svg::text(left_ + kPanelWidth / 2.0, kTop + kPanelHeight + 36, "middle",
                         panel_.xLabel + ", logarithmic");
        return out + svg::textUpwards(left_ - 46, kTop + kPanelHeight / 2.0,
                                      panel_.yLabel + ", logarithmic");
    }

    [[nodiscard]] std::string line(const PlotLine& l, const char* colour, double legendY) const {
        std::string path, marks;
        for (const PlotPoint& p : l.points) {
            if (!isPlottable(p)) continue;
            path += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
            marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\">"
                                 "<title>{}</title></circle>\n",
                                 x(p), y(p), colour, svg::escaped(p.tip));
            if (!p.label.empty())
                marks += svg::text(x(p) + 5, y(p) - 5, "start", p.label, 11, colour);
        }
        return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" "
                           "stroke-width=\"1.8\"/>\n",
                           path, colour) +
               marks + svg::line(left_, legendY - 4, left_ + 26, legendY - 4, colour, 3) +
               svg::text(left_ + 34, legendY, "start", l.legend);
    }

    [[nodiscard]] std::string diamond(const PlotPoint& p) const {
        if (!isPlottable(p)) return {};
        return fmt::format("<path d=\"M{0:.1f} {1:.1f} l6 6 l-6 6 l-6 -6 z\" fill=\"#000\"/>\n",
                           x(p), y(p) - 6) +
               svg::text(x(p) + 9, y(p) + 4, "start", p.label);
    }

    const PlotPanel& panel_;
    double left_;
    LogAxis across_, upwards_;
};

}  // namespace

std::string plotSvg(const std::string& title, const std::vector<PlotPanel>& panels,
                    const std::string& footnote) {
    std::string body;
    std::size_t legend = 0;
    double left = kLeft;
    for (const PlotPanel& panel : panels) {
        body += DrawnPanel(panel, left).drawn();
        left += kPanelWidth + kGap;
        legend = std::max(legend, panel.lines.size());
    }
    const double width = left, height = DrawnPanel::legendAt(legend) + 14;
    body += svg::text(kLeft, DrawnPanel::legendAt(legend), "start", footnote);
    return svg::document(width, height, svg::text(kLeft, 26, "start", title, 17) + body);
}

}  // namespace mfar::eval
