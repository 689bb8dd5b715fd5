#include "daemon/report_charts.h"

#include "base/line_chart.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace mfar {
namespace {

using Bin = RunHistory::Bin;

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

double count(std::uint64_t value) {
    return static_cast<double>(value);
}

/// Returns part / all. If `all` is 0, returns kGap, which makes a gap in the chart.
double share(std::uint64_t part, std::uint64_t all) {
    return all > 0 ? count(part) / count(all) : kGap;
}

class Charts {
public:
    explicit Charts(const RunHistory& history) : history_(history) {
        const double seconds = history.binS() * static_cast<double>(history.bins().size());
        const auto [unitS, unit] = unitFor(seconds);
        label_ = std::string("time [") + unit + "]";
        for (std::size_t i = 0; i < history.bins().size(); ++i)
            x_.push_back((static_cast<double>(i) + 0.5) * history.binS() / unitS);
    }

    [[nodiscard]] std::vector<double> each(const std::function<double(const Bin&)>& value) const {
        std::vector<double> out;
        for (const Bin& bin : history_.bins())
            out.push_back(bin.frames > 0 ? value(bin) : kGap);
        return out;
    }

    /// `value` computes a bin's value from the totals of the previous bin with pictures and of the
    /// bin itself.
    using Change = std::function<double(const RunTotals& before, const RunTotals& now)>;
    [[nodiscard]] std::vector<double> changes(const Change& value) const {
        RunTotals before;
        return each(
            [&](const Bin& bin) { return value(std::exchange(before, bin.totals), bin.totals); });
    }

    /// Returns how much a total grows per second, for each bin, since the previous bin with
    /// pictures. The last bin covers only a part of its time, so it becomes a gap in the chart.
    [[nodiscard]] std::vector<double> rate(std::uint64_t RunTotals::* total) const {
        double before = 0, seconds = 0;
        std::vector<double> out;
        for (const Bin& bin : history_.bins()) {
            seconds += history_.binS();
            out.push_back(kGap);
            if (bin.frames == 0) continue;
            const double now = count(bin.totals.*total);
            out.back() = (now - std::exchange(before, now)) / std::exchange(seconds, 0);
        }
        return full(std::move(out));
    }
    [[nodiscard]] std::vector<double> full(std::vector<double> rates) const {
        if (rates.size() > 1) rates.back() = kGap;
        return rates;
    }

    [[nodiscard]] std::string drawn(std::string title, std::vector<ChartLine> lines,
                                    bool fills = false) const {
        return chartSvg(make(std::move(title), std::move(lines), fills));
    }
    [[nodiscard]] LineChart make(std::string title, std::vector<ChartLine> lines,
                                 bool fills = false) const {
        return {std::move(title), label_, x_, std::move(lines), fills, {}, {}};
    }

    /// Returns one chart line per quantile of a time. `spread` returns the distribution of the
    /// times in a bin, or null.
    using Spread = std::function<const TimeSpread*(const Bin&)>;
    [[nodiscard]] std::vector<ChartLine> quantiles(const Spread& spread) const {
        const auto line = [&](const char* name, double q) {
            return ChartLine{name, each([&](const Bin& bin) {
                                 const TimeSpread* times = spread(bin);
                                 return times != nullptr ? times->quantile(q) : kGap;
                             })};
        };
        return {line("median", 0.5), line("95 %", 0.95)};
    }

private:
    static std::pair<double, const char*> unitFor(double seconds) {
        constexpr double kMinute = 60, kHour = 3600, kDay = 86400;
        if (seconds > 4 * kDay) return {kDay, "days"};
        if (seconds > 3 * kHour) return {kHour, "h"};
        if (seconds > 3 * kMinute) return {kMinute, "min"};
        return {1, "s"};
    }

    const RunHistory& history_;
    std::string label_;
    std::vector<double> x_;
};

bool hasValues(const std::vector<double>& values) {
    return std::ranges::any_of(values, [](double value) { return value > 0 || value < 0; });
}

std::string frameTimes(const Charts& charts, double deadlineMs) {
    std::vector<ChartLine> lines = charts.quantiles([](const Bin& bin) { return &bin.frameMs; });
    lines.push_back(
        {"longest", charts.each([](const Bin& bin) { return bin.frameMs.quantile(1); })});
    LineChart chart = charts.make("Frame time [ms]", std::move(lines), true);
    if (deadlineMs > 0) chart.rule = {"deadline", {deadlineMs}};
    return chartSvg(chart);
}

std::string rates(const Charts& charts, double binS) {
    std::vector<ChartLine> lines{{"shown", charts.full(charts.each([&](const Bin& bin) {
                                      return count(bin.frames) / binS;
                                  }))}};
    const std::pair<const char*, std::uint64_t RunTotals::*> drops[] = {
        {"dropped", &RunTotals::notTaken},
        {"not recorded", &RunTotals::notRecorded},
        {"not written", &RunTotals::notWritten}};
    for (const auto& [name, total] : drops)
        if (ChartLine line{name, charts.rate(total)}; total == drops[0].second || hasValues(line.y))
            lines.push_back(std::move(line));
    return charts.drawn("Frames per second, and drops", std::move(lines));
}

std::string shares(const Charts& charts) {
    LineChart chart = charts.make(
        "Confidence, and share of frames with a pose",
        {{"confidence", charts.each([](const Bin& bin) {
              return bin.confidenceFrames > 0 ? bin.confidenceSum / count(bin.confidenceFrames)
                                              : kGap;
          })},
         {"tracked", charts.changes([](const RunTotals& before, const RunTotals& now) {
              return share(now.posesFound - before.posesFound, now.posesAsked - before.posesAsked);
          })}});
    chart.mostY = 1;
    return chartSvg(chart);
}

std::string stills(const Charts& charts) {
    const auto line = [&](const char* name, std::uint64_t RunTotals::* total) {
        return ChartLine{name,
                         charts.each([&](const Bin& bin) { return count(bin.totals.*total); })};
    };
    return charts.drawn("Stills since the start", {line("received", &RunTotals::stillsReceived),
                                                   line("used", &RunTotals::stillsUsed),
                                                   line("lost", &RunTotals::stillsLost)});
}

}  // namespace

std::string runCharts(const RunHistory& history, double deadlineMs) {
    const Charts charts(history);
    std::string out = frameTimes(charts, deadlineMs);
    out += charts.drawn("Latency [ms], from a frame's arrival until its picture is shown",
                        charts.quantiles([](const Bin& bin) { return &bin.latencyMs; }), true);
    out += rates(charts, history.binS());
    if (deadlineMs > 0)
        out += charts.drawn("Late frames [%]", {{"late", charts.each([](const Bin& bin) {
                                                     return 100 * share(bin.late, bin.frames);
                                                 })}});
    out += shares(charts);
    out += stills(charts);
    const std::vector<double> gain =
        charts.each([](const Bin& bin) { return bin.totals.learnedGainDb; });
    if (hasValues(gain))
        out += charts.drawn("Gain of the learned filters over bicubic [dB]", {{"gain", gain}});
    return out;
}

std::string stageCharts(const RunHistory& history) {
    const Charts charts(history);
    std::string out;
    for (std::size_t i = 0; i < history.stages().size(); ++i)
        out += charts.drawn(history.stages()[i] + " [ms]",
                            charts.quantiles([i](const Bin& bin) -> const TimeSpread* {
                                return i < bin.stageMs.size() ? &bin.stageMs[i] : nullptr;
                            }),
                            true);
    return out;
}

}  // namespace mfar
