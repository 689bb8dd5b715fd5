#include "tests/measure/bench/pareto.h"

#include "tests/measure/eval/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace mfar::bench {
namespace {

const char* word(ParetoPoint::Kind kind) {
    switch (kind) {
    case ParetoPoint::Kind::Ours: return "ours";
    case ParetoPoint::Kind::Default: return "default";
    case ParetoPoint::Kind::Peer: return "peer";
    }
    return "";
}

bool isFinite(const ParetoPoint& p) {
    return std::isfinite(p.ms) && std::isfinite(p.error);
}

std::string measured(const ParetoPoint& p) {
    return fmt::format("{:10.2f} ms {:9.4f}", p.ms, p.error);
}

std::string summaryOf(const ParetoStage& stage) {
    std::string free, dominated, peers;
    for (const ParetoPoint& p : stage.points) {
        const std::string line =
            fmt::format("  {:<34} {}{}", p.name, measured(p),
                        p.kind == ParetoPoint::Kind::Default ? "  default" : "");
        if (p.kind == ParetoPoint::Kind::Peer) {
            peers += line + "\n";
        } else if (const auto by = dominatingPeers(stage, p); by.empty()) {
            free += line + "\n";
        } else {
            dominated += fmt::format("{}  dominated by {}\n", line, fmt::join(by, ", "));
        }
    }
    const auto part = [](const char* title, const std::string& lines) {
        return fmt::format(" {}\n{}", title, lines.empty() ? "  none\n" : lines);
    };
    return fmt::format("{} ({}; {})\n", stage.name, stage.measure, stage.samples) +
           part("settings of mfar that none of the other methods dominates:", free) +
           part("settings of mfar that one of the other methods dominates:", dominated) +
           part("other methods:", peers);
}

}  // namespace

bool dominates(const ParetoPoint& a, const ParetoPoint& b) {
    if (!isFinite(a) || !isFinite(b)) return false;
    return a.ms <= b.ms && a.error <= b.error && (a.ms < b.ms || a.error < b.error);
}

std::vector<std::size_t> paretoFront(const std::vector<ParetoPoint>& points) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto beats = [&](const ParetoPoint& p) { return dominates(p, points[i]); };
        if (isFinite(points[i]) && std::ranges::none_of(points, beats)) out.push_back(i);
    }
    std::ranges::sort(out, {}, [&](std::size_t i) { return std::pair(points[i].ms, i); });
    return out;
}

std::vector<std::string> dominatingPeers(const ParetoStage& stage, const ParetoPoint& point) {
    std::vector<std::string> out;
    for (const ParetoPoint& p : stage.points)
        if (p.kind == ParetoPoint::Kind::Peer && dominates(p, point)) out.push_back(p.name);
    return out;
}

std::string paretoCsv(const std::vector<ParetoStage>& stages) {
    std::string out = "stage,name,kind,ms,error,measure,front,dominated_by\n";
    for (const ParetoStage& stage : stages) {
        const auto front = paretoFront(stage.points);
        for (std::size_t i = 0; i < stage.points.size(); ++i) {
            const ParetoPoint& p = stage.points[i];
            out += fmt::format("{},{},{},{:.3f},{:.5f},{},{},{}\n", stage.name,
                               eval::csvField(p.name), word(p.kind), p.ms, p.error, stage.measure,
                               std::ranges::count(front, i),
                               fmt::join(dominatingPeers(stage, p), " "));
        }
    }
    return out;
}

std::string paretoSummary(const std::vector<ParetoStage>& stages) {
    std::string out;
    for (const ParetoStage& stage : stages)
        out += summaryOf(stage) + "\n";
    return out;
}

}  // namespace mfar::bench
