#include "tests/measure/bench/skips.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace mfar::bench {
namespace {

constexpr double kMostLost = 0.1;
constexpr double kLeastSaved = 0.02;

std::string value(const std::optional<double>& v) {
    return v ? fmt::format("{:+.3f}", *v) : "-";
}

std::string csvValue(const std::optional<double>& v) {
    return v ? fmt::format("{:.5f}", *v) : "";
}

bool isTooMuch(const std::optional<double>& lost) {
    return lost && *lost > kMostLost;
}

bool loses(const SkipResult& r) {
    return isTooMuch(r.psnrLost) || isTooMuch(r.bad1Added) || isTooMuch(r.overlapLost);
}

bool saves(const SkipResult& r) {
    return r.msWithout - r.ms > kLeastSaved * r.msWithout;
}

std::string verdicts(const SkipReport& report) {
    std::vector<std::string> names;
    for (const SkipResult& r : report.results)
        if (std::ranges::find(names, r.skip) == names.end()) names.push_back(r.skip);
    std::string out;
    for (const std::string& name : names) {
        std::string where, costs;
        for (const SkipResult& r : report.results) {
            if (r.skip != name) continue;
            if (saves(r)) where += " " + r.scene;
            if (loses(r)) costs += " " + r.scene;
        }
        out += fmt::format(
            "  {:<20} saves time in {}{}\n", name,
            where.empty() ? "no case" : "these cases:" + where,
            costs.empty()
                ? ""
                : "; loses more than 0.1 dB or 0.1 percentage points in these cases:" + costs);
    }
    return out;
}

}  // namespace

std::string skipTable(const SkipReport& report) {
    std::string out =
        fmt::format("With all skips: time of a frame [ms], number of tiles that need depth, "
                    "number of frames with an object in view, share of tiles drawn again\n"
                    "{:<14}{:>9}{:>13}{:>9}{:>10}\n",
                    "case", "ms", "depth tiles", "in view", "redrawn");
    for (const SkipCase& c : report.cases)
        out += fmt::format("{:<14}{:>9.2f}{:>13}{:>9}{:>9.1f}%\n", c.scene, c.ms, c.depthTiles,
                           c.framesInView, 100 * c.redrawn);
    out +=
        "\nTime of a frame [ms] with and without each skip, and the accuracy that the skip loses "
        "(bad-1, overlap: percentage points; losses above 0.1 are marked)\n";
    out += fmt::format("{:<14}{:<20}{:>9}{:>10}{:>9}{:>9}{:>10}{:>10}\n", "case", "skip", "ms",
                       "without", "saved", "dB lost", "bad-1", "overlap");
    for (const SkipResult& r : report.results)
        out += fmt::format("{:<14}{:<20}{:>9.2f}{:>10.2f}{:>9.2f}{:>9}{:>10}{:>10}{}\n", r.scene,
                           r.skip, r.ms, r.msWithout, r.msWithout - r.ms, value(r.psnrLost),
                           value(r.bad1Added), value(r.overlapLost), loses(r) ? "  !" : "");
    return out + "\n" + verdicts(report);
}

std::string skipCsv(const SkipReport& report) {
    std::string out = "case,skip,ms,ms_without,saved_ms,psnr_lost_db,bad1_added,overlap_lost\n";
    for (const SkipResult& r : report.results)
        out += fmt::format("{},{},{:.3f},{:.3f},{:.3f},{},{},{}\n", r.scene, r.skip, r.ms,
                           r.msWithout, r.msWithout - r.ms, csvValue(r.psnrLost),
                           csvValue(r.bad1Added), csvValue(r.overlapLost));
    return out;
}

}  // namespace mfar::bench
