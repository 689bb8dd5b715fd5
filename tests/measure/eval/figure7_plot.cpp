#include "base/svg.h"
#include "tests/measure/eval/figure7_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace mfar::eval {
namespace {

constexpr double kFigureLeft = 64, kFigureTop = 72, kFigureHeight = 230, kFigureGap = 64;
constexpr double kBar = 25, kBarGap = 3, kGroupGap = 34;
constexpr std::array<const char*, 6> kBarColours{"#444444", "#0072b2", "#56b4e9",
                                                 "#d55e00", "#009e73", "#cc79a7"};
constexpr std::array<const char*, 6> kBarInk{"#fff", "#fff", "#111", "#fff", "#fff", "#111"};

struct Figure7Panel {
    std::string title;
    std::function<double(const PictureScores&)> value;
    double least, most, step;
    int decimals;
    bool tiles;
};

double groupWidth() {
    return static_cast<double>(figure7Methods().size()) * (kBar + kBarGap) + kGroupGap;
}

class Figure7Bars {
public:
    Figure7Bars(const Figure7Panel& panel, double top) : panel_(panel), top_(top) {}

    [[nodiscard]] std::string axis(double width) const {
        std::string out;
        for (double v = panel_.least; v <= panel_.most + 1e-9; v += panel_.step) {
            out += svg::line(kFigureLeft, y(v), kFigureLeft + width, y(v),
                             std::abs(v) < 1e-9 ? "#888" : "#ddd");
            out += svg::text(kFigureLeft - 6, y(v) + 4, "end", fmt::format("{:g}", v));
        }
        return out + svg::text(kFigureLeft, top_ - 12, "start", panel_.title, 14);
    }

    [[nodiscard]] std::string group(const Figure7Scene& scene, double left) const {
        std::string out;
        for (std::size_t m = 0; m < scene.scores.size(); ++m)
            out += bar(scene, m, left + kGroupGap / 2 + static_cast<double>(m) * (kBar + kBarGap));
        const double truth = y(scene.mean(0, panel_.value));
        return out + fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                                 "stroke=\"#444\" stroke-dasharray=\"4 3\"/>\n",
                                 left + kGroupGap / 2, truth, left + groupWidth() - kGroupGap / 2,
                                 truth);
    }

private:
    [[nodiscard]] double y(double v) const {
        v = std::clamp(v, panel_.least, panel_.most);
        return top_ + kFigureHeight * (panel_.most - v) / (panel_.most - panel_.least);
    }

    [[nodiscard]] std::string bar(const Figure7Scene& scene, std::size_t m, double x) const {
        const double mean = scene.mean(m, panel_.value), zero = y(0), end = y(mean);
        std::string out = fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"{}\">"
            "<title>{}, {}: {:.{}f}</title></rect>\n",
            x, std::min(zero, end), kBar, std::abs(zero - end), kBarColours[m],
            svg::escaped(scene.name), svg::escaped(figure7Methods()[m].title), mean,
            panel_.decimals);
        for (const PictureScores& frame : scene.scores[m])
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"#fff\" "
                               "stroke=\"#222\" stroke-width=\"0.8\"/>\n",
                               x + kBar / 2, y(panel_.value(frame)));
        // A bar of enough height has its number inside, at the foot. Other bars have it above.
        const bool inside = zero - end > 18;
        out += svg::text(x + kBar / 2, inside ? zero - 6 : std::min(zero, end) - 6, "middle",
                         fmt::format("{:.{}f}", mean, mean > 99.9 ? 0 : panel_.decimals), 10,
                         inside ? kBarInk[m] : "#222");
        return panel_.tiles ? out + quantiles(scene, m, x) : out;
    }

    [[nodiscard]] std::string quantiles(const Figure7Scene& scene, std::size_t m, double x) const {
        const auto of = [&](double LpcTiles::* which) {
            return y(scene.mean(m, [&](const PictureScores& s) { return (*s.tiles).*which; }));
        };
        const double p10 = of(&LpcTiles::p10), p90 = of(&LpcTiles::p90);
        const double median = of(&LpcTiles::median), at = x + 5;
        return svg::line(at, p10, at, p90, "#fff", 3) + svg::line(at, p10, at, p90, "#000", 1.4) +
               svg::line(at - 4, median, at + 4, median, "#fff", 4) +
               svg::line(at - 4, median, at + 4, median, "#000", 2.4);
    }

    const Figure7Panel& panel_;
    double top_;
};

double leastOf(const std::vector<Figure7Scene>& scenes, const Figure7Panel& panel) {
    double out = 0;
    for (const Figure7Scene& scene : scenes)
        for (const auto& frames : scene.scores)
            for (const PictureScores& frame : frames)
                out = std::min(out, panel.value(frame));
    return panel.step * std::floor(out / panel.step);
}

std::string legend(double top, const PictureMetrics& metrics) {
    std::string out;
    for (std::size_t m = 0; m < figure7Methods().size(); ++m) {
        const std::size_t column = m % 3, row = m / 3;
        const double x = kFigureLeft + 250 * static_cast<double>(column);
        const double y = top + 20 * static_cast<double>(row);
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"12\" "
                           "fill=\"{}\"/>\n",
                           x, y - 10, kBarColours[m]);
        out += svg::text(x + 20, y, "start", figure7Methods()[m].title);
    }
    const HdrVdpDisplay& display = metrics.display;
    out +=
        svg::text(kFigureLeft, top + 46, "start",
                  "Bars: mean of the frames. Dots: single frames. Black marks at LPC-SI: median, "
                  "10th and 90th percentile of the picture's 64 equal parts. Dashed: ground truth.",
                  11);
    return out + svg::text(kFigureLeft, top + 62, "start",
                           fmt::format("HDR-VDP 2.2.2 of luma at {:g} pixels per degree, display "
                                       "{:g} to {:g} cd/m\u00b2, gamma {:g}. LPC-SI: bandwidth "
                                       "ratio {:g}. Borders of 32 px left out.",
                                       display.pixelsPerDegree, display.black, display.peak,
                                       display.gamma, metrics.lpcRatio),
                           11);
}

}  // namespace

std::string figure7Svg(const std::vector<Figure7Scene>& scenes, const PictureMetrics& metrics) {
    std::array<Figure7Panel, 2> panels{
        {{"HDR-VDP-2 quality Q (100: no visible difference)",
          [](const PictureScores& s) { return *s.hdrVdpQ; }, 0, 100, 20, 1, false},
         {"LPC-SI sharpness", [](const PictureScores& s) { return *s.lpcSi; }, 0, 1, 0.2, 2,
          true}}};
    const double width = groupWidth() * static_cast<double>(scenes.size());
    std::string body =
        svg::text(kFigureLeft, 22, "start", "Quality and sharpness of super-resolved frames", 17);
    double top = kFigureTop;
    for (Figure7Panel& panel : panels) {
        panel.least = leastOf(scenes, panel);
        const Figure7Bars bars(panel, top);
        body += bars.axis(width);
        double left = kFigureLeft;
        for (const Figure7Scene& scene : scenes) {
            body += bars.group(scene, left);
            body += svg::text(left + groupWidth() / 2, top + kFigureHeight + 20, "middle",
                              scene.name, 13);
            left += groupWidth();
        }
        top += kFigureHeight + kFigureGap;
    }
    return svg::document(std::max(kFigureLeft + width + 20, 840.0), top + 72,
                         body + legend(top, metrics));
}

}  // namespace mfar::eval
