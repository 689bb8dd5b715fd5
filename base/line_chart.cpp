#include "base/line_chart.h"

#include "base/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace mfar {
namespace {

constexpr double kWidth = 460, kHeight = 210;
constexpr double kLeft = 46, kRight = 448, kTop = 46, kBottom = 174;
constexpr int kAcross = 6, kUpwards = 4;
constexpr int kSmall = 11;

class DrawnChart {
public:
    explicit DrawnChart(const LineChart& chart) : chart_(chart) {
        if (!chart.x.empty()) {
            leastX_ = chart.x.front();
            mostX_ = chart.x.back();
        }
        for (const ChartLine& line : chart.lines)
            include(line.y);
        if (chart.rule) include(chart.rule->y);
        if (chart.mostY) mostY_ = *chart.mostY;
        if (!(mostX_ > leastX_)) mostX_ = leastX_ + 1;
        if (!(mostY_ > leastY_)) mostY_ = leastY_ + 1;
        if (!chart.mostY) mostY_ += 0.06 * (mostY_ - leastY_);
    }

    [[nodiscard]] std::string drawn() const {
        std::string out = svg::text(kLeft, 16, "start", chart_.title, 13) + axes();
        if (chart_.fills && chart_.lines.size() > 1) out += area();
        double legend = kLeft;
        for (std::size_t i = 0; i < chart_.lines.size(); ++i) {
            const char* colour = svg::kColours[i % svg::kColours.size()];
            out += line(chart_.lines[i].y, colour);
            out += entry(legend, chart_.lines[i].name, colour);
        }
        if (chart_.rule) out += rule(legend);
        return out;
    }

private:
    void include(std::span<const double> values) {
        for (const double value : values) {
            if (!std::isfinite(value)) continue;
            leastY_ = std::min(leastY_, value);
            mostY_ = std::max(mostY_, value);
        }
    }
    [[nodiscard]] double atX(double x) const {
        return kLeft + (kRight - kLeft) * (x - leastX_) / (mostX_ - leastX_);
    }
    [[nodiscard]] double atY(double y) const {
        return kBottom - (kBottom - kTop) * (y - leastY_) / (mostY_ - leastY_);
    }
    [[nodiscard]] std::string point(std::size_t i, double y) const {
        return fmt::format("{:.1f},{:.1f} ", atX(chart_.x[i]), atY(y));
    }

    [[nodiscard]] std::string axes() const {
        std::string out;
        for (const double y : linearTicks(leastY_, mostY_, kUpwards)) {
            out += svg::line(kLeft, atY(y), kRight, atY(y));
            out += svg::text(kLeft - 5, atY(y) + 4, "end", fmt::format("{:g}", y), kSmall);
        }
        for (const double x : linearTicks(leastX_, mostX_, kAcross)) {
            out += svg::line(atX(x), kBottom, atX(x), kBottom + 4, "#888");
            out += svg::text(atX(x), kBottom + 16, "middle", fmt::format("{:g}", x), kSmall);
        }
        out += svg::line(kLeft, kBottom, kRight, kBottom, "#888");
        return out + svg::text((kLeft + kRight) / 2, kBottom + 32, "middle", chart_.xLabel, kSmall);
    }

    // A point between two gaps is drawn as a line of length 0; its round caps make it visible.
    [[nodiscard]] std::string line(std::span<const double> values, const char* colour) const {
        std::string out, points;
        const auto end = [&] {
            if (!points.empty())
                out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" "
                                   "stroke-width=\"1.6\" stroke-linecap=\"round\" "
                                   "stroke-linejoin=\"round\"/>\n",
                                   points, colour);
            points.clear();
        };
        for (std::size_t i = 0; i < std::min(values.size(), chart_.x.size()); ++i) {
            if (!std::isfinite(values[i])) {
                end();
                continue;
            }
            if (points.empty()) points = point(i, values[i]);
            points += point(i, values[i]);
        }
        end();
        return out;
    }

    [[nodiscard]] std::string area() const {
        const std::vector<double>&one = chart_.lines[0].y, &other = chart_.lines[1].y;
        const std::size_t count = std::min({one.size(), other.size(), chart_.x.size()});
        std::string out, there, back;
        for (std::size_t i = 0; i <= count; ++i) {
            if (i < count && std::isfinite(one[i]) && std::isfinite(other[i])) {
                there += point(i, one[i]);
                back.insert(0, point(i, other[i]));
                continue;
            }
            if (!there.empty())
                out += fmt::format("<polygon points=\"{}{}\" fill=\"{}\" fill-opacity=\"0.13\"/>\n",
                                   there, back, svg::kColours[0]);
            there.clear();
            back.clear();
        }
        return out;
    }

    /// Returns the SVG text of a legend's entry that begins at `x`. Moves `x` to the position where
    /// the next entry begins.
    [[nodiscard]] static std::string entry(double& x, const std::string& name, const char* colour) {
        constexpr double kSample = 14, kLetter = 6.2, kGap = 26;
        const std::string out = svg::line(x, 30, x + kSample, 30, colour, 3) +
                                svg::text(x + kSample + 5, 34, "start", name, kSmall);
        x += kSample + kLetter * static_cast<double>(name.size()) + kGap;
        return out;
    }

    [[nodiscard]] std::string rule(double& legend) const {
        const double y = atY(chart_.rule->y.front());
        return fmt::format("<line x1=\"{}\" y1=\"{:.1f}\" x2=\"{}\" y2=\"{:.1f}\" stroke=\"#444\" "
                           "stroke-dasharray=\"5 4\"/>\n",
                           kLeft, y, kRight, y) +
               entry(legend, chart_.rule->name, "#444");
    }

    const LineChart& chart_;
    double leastX_ = 0, mostX_ = 0, leastY_ = 0, mostY_ = 0;
};

}  // namespace

std::vector<double> linearTicks(double least, double most, int count) {
    std::vector<double> out;
    if (!(most > least) || !std::isfinite(most - least)) return out;
    const double wanted = (most - least) / count;
    const double power = std::pow(10, std::floor(std::log10(wanted)));
    double step = 10 * power;
    for (const double digit : {5.0, 2.0, 1.0})
        if (digit * power >= wanted) step = digit * power;
    for (double at = std::ceil(least / step); at * step <= most * (1 + 1e-9); ++at)
        out.push_back(at * step);
    return out;
}

std::string chartSvg(const LineChart& chart) {
    return svg::document(kWidth, kHeight, DrawnChart(chart).drawn());
}

}  // namespace mfar
