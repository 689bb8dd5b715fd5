#include "tests/eval/plot.h"

#include "tests/eval/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>

namespace mfar::eval {
namespace {

// Okabe and Ito.
constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                              "#e69f00", "#56b4e9", "#444444"};
constexpr int kPanelWidth = 470, kPanelHeight = 380, kLeft = 70, kTop = 70, kGap = 70;
constexpr int kLegendLine = 20, kBelow = 64;

/// Text of anybody as the content of an element.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '&': out += "&amp;"; break;
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        default: out += c;
        }
    }
    return out;
}

std::string svgText(double x, double y, std::string_view anchor, std::string_view what,
                    int size = 12, std::string_view colour = "#222") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\" "
                       "fill=\"{}\">{}</text>\n",
                       x, y, size, anchor, colour, escaped(what));
}

std::string gridLine(double x0, double y0, double x1, double y1) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                       "stroke=\"#ddd\"/>\n",
                       x0, y0, x1, y1);
}

bool isPlottable(const PlotPoint& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0 && p.y >= 0;
}

/// A logarithmic axis over all that was included.
class LogAxis {
public:
    void include(double value) {
        least_ = std::min(least_, value);
        most_ = std::max(most_, value);
    }
    /// Where a value lies, [0, 1] for what was included and a margin.
    [[nodiscard]] double at(double value) const {
        if (!(least_ <= most_)) return 0;
        return (std::log(value / least_) + kMargin) / (std::log(most_ / least_) + 2 * kMargin);
    }
    /// Round values on the axis.
    [[nodiscard]] std::vector<double> ticks() const {
        const bool isShort = most_ < 10 * least_, isLong = most_ > 1000 * least_;
        std::vector<double> out;
        for (int power = -9; power <= 9; ++power)
            for (const double digit : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0})
                if (isShort || digit == 1 || (!isLong && (digit == 2 || digit == 5))) {
                    const double v = digit * std::pow(10, power), where = at(v);
                    if (where > 0 && where < 1) out.push_back(v);
                }
        return out;
    }

private:
    static constexpr double kMargin = 0.12;

    double least_ = 1e300, most_ = 0;
};

/// A panel with its legend, its left edge at `left`.
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

    [[nodiscard]] std::string svg() const {
        std::string out = svgText(left_ + kPanelWidth / 2.0, kTop - 12, "middle", panel_.title, 15);
        out += axes();
        for (std::size_t i = 0; i < panel_.lines.size(); ++i)
            out += line(panel_.lines[i], kColours[i % kColours.size()], legendAt(i));
        for (const PlotPoint& p : panel_.diamonds)
            out += diamond(p);
        if (panel_.ringed && isPlottable(*panel_.ringed))
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\" fill=\"none\" "
                               "stroke=\"#000\" stroke-width=\"1.5\"/>\n",
                               x(*panel_.ringed), y(*panel_.ringed)) +
                   svgText(x(*panel_.ringed) - 11, y(*panel_.ringed) + 16, "end",
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
            out += gridLine(left_, yOf(value), left_ + kPanelWidth, yOf(value));
            out += svgText(left_ - 6, yOf(value) + 4, "end", fmt::format("{:g}", value));
        }
        for (const double value : across_.ticks()) {
            const double at = left_ + kPanelWidth * across_.at(value);
            out += gridLine(at, kTop, at, kTop + kPanelHeight);
            out += svgText(at, kTop + kPanelHeight + 16, "middle", fmt::format("{:g}", value));
        }
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                           "stroke=\"#888\"/>\n",
                           left_, kTop, kPanelWidth, kPanelHeight);
        out += svgText(left_ + kPanelWidth / 2.0, kTop + kPanelHeight + 36, "middle",
                       panel_.xLabel + ", logarithmic");
        return out + fmt::format("<text transform=\"translate({:.1f},{}) rotate(-90)\" "
                                 "font-size=\"12\" text-anchor=\"middle\" fill=\"#222\">{}, "
                                 "logarithmic</text>\n",
                                 left_ - 46, kTop + kPanelHeight / 2, escaped(panel_.yLabel));
    }

    [[nodiscard]] std::string line(const PlotLine& l, const char* colour, double legendY) const {
        std::string path, marks;
        for (const PlotPoint& p : l.points) {
            if (!isPlottable(p)) continue;
            path += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
            marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\">"
                                 "<title>{}</title></circle>\n",
                                 x(p), y(p), colour, escaped(p.tip));
            if (!p.label.empty())
                marks += svgText(x(p) + 5, y(p) - 5, "start", p.label, 11, colour);
        }
        return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" "
                           "stroke-width=\"1.8\"/>\n",
                           path, colour) +
               marks +
               fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                           "stroke=\"{}\" stroke-width=\"3\"/>\n",
                           left_, legendY - 4, left_ + 26, legendY - 4, colour) +
               svgText(left_ + 34, legendY, "start", l.legend);
    }

    [[nodiscard]] std::string diamond(const PlotPoint& p) const {
        if (!isPlottable(p)) return {};
        return fmt::format("<path d=\"M{0:.1f} {1:.1f} l6 6 l-6 6 l-6 -6 z\" fill=\"#000\"/>\n",
                           x(p), y(p) - 6) +
               svgText(x(p) + 9, y(p) + 4, "start", p.label);
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
        body += DrawnPanel(panel, left).svg();
        left += kPanelWidth + kGap;
        legend = std::max(legend, panel.lines.size());
    }
    const double width = left, height = DrawnPanel::legendAt(legend) + 14;
    body += svgText(kLeft, DrawnPanel::legendAt(legend), "start", footnote);
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
                       "height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                       "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" "
                       "fill=\"#fff\"/>\n",
                       width, height) +
           svgText(kLeft, 26, "start", title, 17) + body + "</svg>\n";
}

void writePlot(const std::filesystem::path& file, const std::string& svg) {
    std::ofstream out(file);
    out << svg;
    if (!out.flush()) throw EvalError(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace mfar::eval
