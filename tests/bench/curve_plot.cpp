#include "tests/bench/curve_report.h"
#include "tests/eval/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace mfar::bench {
namespace {

using eval::svg::escaped;
using eval::svg::line;
using eval::svg::text;

constexpr int kPanelWidth = 470, kPanelHeight = 380, kLeft = 70, kTop = 70, kGap = 70;
constexpr int kLegendLine = 20, kBelow = 64;

/// A time is positive and a share not negative, or there is nothing to draw.
bool isPlottable(const CurvePoint& p) {
    return std::isfinite(p.ms) && std::isfinite(p.bad1) && p.ms > 0 && p.bad1 >= 0;
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
        const bool isShort = most_ < 10 * least_;
        std::vector<double> out;
        for (int power = -3; power <= 6; ++power)
            for (const double digit : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0})
                if (isShort || digit == 1 || digit == 2 || digit == 5) {
                    const double v = digit * std::pow(10, power), where = at(v);
                    if (where > 0 && where < 1) out.push_back(v);
                }
        return out;
    }

private:
    static constexpr double kMargin = 0.12;

    double least_ = 1e300, most_ = 0;
};

/// Where time [ms] and bad-1 [%] lie in a panel.
class Axes {
public:
    void include(const CurvePoint& p) {
        if (!isPlottable(p)) return;
        time_.include(p.ms);
        bad_.include(percent(p));
    }
    [[nodiscard]] double x(const CurvePoint& p) const { return kPanelWidth * time_.at(p.ms); }
    [[nodiscard]] double y(const CurvePoint& p) const { return yOf(percent(p)); }

    [[nodiscard]] std::string svg(double left) const {
        std::string out;
        for (const double percent : bad_.ticks()) {
            const double at = kTop + yOf(percent);
            out += line(left, at, left + kPanelWidth, at);
            out += text(left - 6, at + 4, "end", fmt::format("{:g}", percent));
        }
        for (const double ms : time_.ticks()) {
            const double at = left + kPanelWidth * time_.at(ms);
            out += line(at, kTop, at, kTop + kPanelHeight);
            out += text(at, kTop + kPanelHeight + 16, "middle", fmt::format("{:g}", ms));
        }
        out += fmt::format("<rect x=\"{:.1f}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                           "stroke=\"#888\"/>\n",
                           left, kTop, kPanelWidth, kPanelHeight);
        out += text(left + kPanelWidth / 2.0, kTop + kPanelHeight + 36, "middle",
                    "time of the flow [ms], logarithmic");
        return out + eval::svg::textUpwards(left - 40, kTop + kPanelHeight / 2.0,
                                            "bad-1: pixels off by more than 1 px [%], "
                                            "logarithmic");
    }

private:
    // None at all has no logarithm.
    static double percent(const CurvePoint& p) { return std::max(100 * p.bad1, 0.01); }
    [[nodiscard]] double yOf(double percent) const { return kPanelHeight * (1 - bad_.at(percent)); }

    LogAxis time_, bad_;
};

/// One method's panel with its legend, its left edge at `left`.
class Panel {
public:
    Panel(const Axes& axes, double left) : axes_(axes), left_(left) {}

    void draw(const Curve& curve) {
        const char* colour = eval::svg::kColours[lines_ % eval::svg::kColours.size()];
        std::string path, marks, label;
        for (const CurvePoint& p : curve.points) {
            if (!isPlottable(p)) continue;
            path += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
            marks +=
                fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\">"
                            "<title>{} {:g}: {:.1f} ms, {:.2f} %</title></circle>\n",
                            x(p), y(p), colour, escaped(curve.knob), p.value, p.ms, 100 * p.bad1);
            const bool isEnd = &p == &curve.points.front() || &p == &curve.points.back();
            if (isEnd && !p.isDefault)
                marks +=
                    text(x(p) + 5, y(p) - 5, "start", fmt::format("{:g}", p.value), 11, colour);
            if (p.isDefault) default_ = p;
            label += fmt::format("{}{:g}{}", label.empty() ? "" : ", ", p.value,
                                 p.isDefault ? " (default)" : "");
        }
        body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" "
                             "stroke-width=\"1.8\"/>\n",
                             path, colour) +
                 marks;
        const double at = legendAt(lines_++);
        body_ += line(left_, at - 4, left_ + 26, at - 4, colour, 3);
        body_ += text(left_ + 34, at, "start", fmt::format("{}: {}", curve.knob, label));
    }

    void draw(const CurvePeer& peer) {
        if (!isPlottable(peer.point)) return;
        body_ += fmt::format("<path d=\"M{0:.1f} {1:.1f} l6 6 l-6 6 l-6 -6 z\" fill=\"#000\"/>\n",
                             x(peer.point), y(peer.point) - 6);
        body_ += text(x(peer.point) + 9, y(peer.point) + 4, "start", peer.name);
    }

    [[nodiscard]] std::string svg(std::string_view title) const {
        std::string out = text(left_ + kPanelWidth / 2.0, kTop - 12, "middle", title, 15);
        out += axes_.svg(left_) + body_;
        if (default_)
            out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\" fill=\"none\" "
                               "stroke=\"#000\" stroke-width=\"1.5\"/>\n",
                               x(*default_), y(*default_)) +
                   text(x(*default_) - 11, y(*default_) + 16, "end", "default");
        return out;
    }
    static double legendAt(int line) { return kTop + kPanelHeight + kBelow + line * kLegendLine; }

private:
    [[nodiscard]] double x(const CurvePoint& p) const { return left_ + axes_.x(p); }
    [[nodiscard]] double y(const CurvePoint& p) const { return kTop + axes_.y(p); }

    const Axes& axes_;
    double left_;
    std::string body_;
    int lines_ = 0;
    std::optional<CurvePoint> default_;
};

Axes axesOf(const Curves& curves, std::string_view method) {
    Axes out;
    for (const Curve& curve : curves.curves)
        for (const CurvePoint& p : curve.points)
            if (curve.method == method) out.include(p);
    for (const CurvePeer& peer : curves.peers)
        out.include(peer.point);
    return out;
}

}  // namespace

std::string curvesSvg(const Curves& curves) {
    const std::array<std::pair<const char*, const char*>, 2> panels{
        {{"flow2d", "2-D flow, both directions"}, {"epipolar", "search along epipolar lines"}}};
    std::string body;
    int legend = 0;
    double left = kLeft;
    for (const auto& [method, title] : panels) {
        const Axes axes = axesOf(curves, method);
        Panel panel(axes, left);
        int lines = 0;
        for (const Curve& curve : curves.curves)
            if (curve.method == method) {
                panel.draw(curve);
                ++lines;
            }
        for (const CurvePeer& peer : curves.peers)
            panel.draw(peer);
        if (lines > 0) {
            body += panel.svg(title);
            left += kPanelWidth + kGap;
        }
        legend = std::max(legend, lines);
    }
    const double width = left, height = Panel::legendAt(legend) + 14;
    body += text(kLeft, Panel::legendAt(legend), "start",
                 fmt::format("Diamonds: OpenCV, one direction. Samples: {}",
                             fmt::join(curves.samples, ", ")));
    return eval::svg::document(
        width, height,
        text(kLeft, 26, "start", "Time against error of the flow, one knob at a time", 17) + body);
}

}  // namespace mfar::bench
