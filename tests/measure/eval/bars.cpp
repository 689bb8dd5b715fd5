#include "tests/measure/eval/bars.h"

#include "base/line_chart.h"
#include "base/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mfar::eval {
namespace {

constexpr double kBarsWidth = 460, kBarsTop = 34, kBarsRow = 22, kBarsBelow = 26, kBarsRight = 400;
constexpr double kLetter = 6.2;
constexpr std::size_t kBarsColumns = 3;

class DrawnBars {
public:
    explicit DrawnBars(const BarPanel& panel) : panel_(panel) {
        double least = 1e300, most = -1e300;
        std::size_t letters = 0;
        for (const Bar& bar : panel.bars) {
            letters = std::max(letters, bar.label.size());
            for (const double value : valuesOf(bar)) {
                least = std::min(least, value);
                most = std::max(most, value);
            }
        }
        left_ = std::clamp(kLetter * static_cast<double>(letters) + 16, 60.0, 220.0);
        if (least > most) least = most = 0;
        fromZero_ = least <= 0.6 * most || most <= 0;
        const double margin = fromZero_ ? 0 : std::max(0.15 * (most - least), 1e-3 * most);
        least_ = fromZero_ ? std::min(least, 0.0) : least - margin;
        most_ = fromZero_ ? std::max(most, 0.0) : most + margin;
        if (!(most_ > least_)) most_ = least_ + 1;
    }

    [[nodiscard]] SizedSvg drawn() const {
        const double bottom = kBarsTop + kBarsRow * static_cast<double>(panel_.bars.size());
        std::string out = svg::text(12, 18, "start", panel_.title, 13);
        for (const double value : linearTicks(least_, most_, 4)) {
            out += svg::line(x(value), kBarsTop - 4, x(value), bottom);
            out += svg::text(x(value), bottom + 15, "middle", fmt::format("{:g}", value), 11);
        }
        for (std::size_t i = 0; i < panel_.bars.size(); ++i)
            out += bar(panel_.bars[i], kBarsTop + kBarsRow * static_cast<double>(i));
        return {svg::document(kBarsWidth, bottom + kBarsBelow, out), kBarsWidth,
                bottom + kBarsBelow};
    }

private:
    static std::vector<double> valuesOf(const Bar& bar) {
        std::vector<double> out = bar.dots;
        out.push_back(bar.value);
        std::erase_if(out, [](double value) { return !std::isfinite(value); });
        return out;
    }
    [[nodiscard]] double x(double value) const {
        return left_ + (kBarsRight - left_) * (value - least_) / (most_ - least_);
    }

    [[nodiscard]] std::string bar(const Bar& one, double top) const {
        const double middle = top + kBarsRow / 2;
        const char* colour = svg::kColours[one.colour % svg::kColours.size()];
        std::string out = svg::text(left_ - 8, middle + 4, "end", one.label, 11);
        if (!std::isfinite(one.value))
            return out + svg::text(left_ + 6, middle + 4, "start", "not measured", 11, "#888");
        const double zero = x(fromZero_ ? 0 : least_), end = x(one.value);
        if (fromZero_)
            out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\" "
                               "fill=\"{}\"/>\n",
                               std::min(zero, end), top + 4, std::abs(end - zero), kBarsRow - 8,
                               colour);
        double farthest = end;
        for (const double dot : one.dots)
            if (std::isfinite(dot)) {
                out += circle(x(dot), middle, 2, "#fff", "#222");
                farthest = std::max(farthest, x(dot));
            }
        if (!fromZero_) out += circle(end, middle, 5, colour, colour);
        return out + svg::text(std::max(farthest, zero) + 8, middle + 4, "start",
                               fmt::format("{:.{}f}", one.value, panel_.decimals), 11);
    }

    static std::string circle(double x, double y, int radius, const char* fill,
                              const char* stroke) {
        return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" "
                           "stroke-width=\"0.8\"/>\n",
                           x, y, radius, fill, stroke);
    }

    const BarPanel& panel_;
    double left_ = 0, least_ = 0, most_ = 0;
    bool fromZero_ = true;
};

// A row with medians gets no dot and no bar. Some commands add such rows themselves.
bool isMedian(const Report::Row& row) {
    return row.frame == "median";
}

void addUnique(std::vector<std::string>& list, const std::string& value) {
    if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

class ReportRows {
public:
    explicit ReportRows(const Report& report) : report_(report) {
        for (const Report::Row& row : report.rows()) {
            addUnique(methods_, row.method);
            if (!isMean(row)) continue;
            hasMeans_ = true;
            if (row.recording == kAll) hasAll_ = true;
        }
    }

    [[nodiscard]] std::vector<Bar> bars(std::size_t column) const {
        std::vector<Bar> out;
        if (!hasMeans_) {
            for (const Report::Row& row : report_.rows())
                out.push_back({row.recording + " " + row.method,
                               valueOf(row, column),
                               {},
                               colourOf(row.method)});
            return out;
        }
        for (const std::string& method : methods_) {
            Bar bar{method, std::nan(""), {}, colourOf(method)};
            for (const Report::Row& row : report_.rows()) {
                if (row.method != method) continue;
                if (isBar(row))
                    bar.value = valueOf(row, column);
                else if (isDot(row))
                    bar.dots.push_back(valueOf(row, column));
            }
            out.push_back(std::move(bar));
        }
        return out;
    }

private:
    static constexpr const char* kAll = "all";

    static bool isMean(const Report::Row& row) { return row.ofFrames && row.frame == "mean"; }
    [[nodiscard]] bool isBar(const Report::Row& row) const {
        return isMean(row) && (!hasAll_ || row.recording == kAll);
    }
    [[nodiscard]] bool isDot(const Report::Row& row) const {
        return hasAll_ ? isMean(row) : !row.ofFrames && !isMedian(row);
    }
    static double valueOf(const Report::Row& row, std::size_t column) {
        return row.values[column].value_or(std::nan(""));
    }
    [[nodiscard]] std::size_t colourOf(const std::string& method) const {
        return static_cast<std::size_t>(std::ranges::find(methods_, method) - methods_.begin());
    }

    const Report& report_;
    std::vector<std::string> methods_;
    bool hasMeans_ = false, hasAll_ = false;
};

}  // namespace

std::string gridSvg(const std::string& title, const std::vector<SizedSvg>& parts,
                    std::size_t columns, const std::string& footnote) {
    constexpr double kMargin = 10;
    double y = 44, widest = 400;
    std::string body = svg::text(kMargin, 26, "start", title, 17);
    for (std::size_t begin = 0; begin < parts.size(); begin += columns) {
        double x = kMargin, highest = 0;
        for (std::size_t i = begin; i < std::min(begin + columns, parts.size()); ++i) {
            body += fmt::format("<g transform=\"translate({:.0f},{:.0f})\">\n{}</g>\n", x, y,
                                parts[i].svg);
            x += parts[i].width;
            highest = std::max(highest, parts[i].height);
        }
        widest = std::max(widest, x);
        y += highest + kMargin;
    }
    body += svg::text(kMargin, y + 14, "start", footnote);
    return svg::document(widest + kMargin, y + 28, body);
}

std::string barsSvg(const std::string& title, const std::vector<BarPanel>& panels,
                    const std::string& footnote) {
    std::vector<SizedSvg> parts;
    for (const BarPanel& panel : panels)
        parts.push_back(DrawnBars(panel).drawn());
    return gridSvg(title, parts, kBarsColumns, footnote);
}

std::vector<BarPanel> barsOf(const Report& report) {
    const ReportRows rows(report);
    std::vector<BarPanel> out;
    for (std::size_t c = 0; c < report.columns().size(); ++c) {
        const bool isMeasured = std::ranges::any_of(report.rows(), [&](const Report::Row& row) {
            return row.values[c].has_value() && !isMedian(row);
        });
        if (isMeasured)
            out.push_back({report.columns()[c].name, rows.bars(c), report.columns()[c].decimals});
    }
    return out;
}

}  // namespace mfar::eval
