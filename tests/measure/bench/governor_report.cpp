#include "tests/measure/bench/governor_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mfar::bench {
namespace {

constexpr std::size_t kSettling = 30;  // frames that the governor gets to adapt to a new scene

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    const auto rank =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

std::string levelsOf(const GovernedScene& scene) {
    std::vector<std::pair<int, std::string>> byFrames;
    for (const auto& [name, frames] : scene.levels)
        byFrames.emplace_back(frames, name);
    std::ranges::sort(byFrames, std::greater<>());
    std::string out;
    for (const auto& [frames, name] : byFrames)
        out += fmt::format(" {} ({})", name, frames);
    return out;
}

}  // namespace

int settledAfter(std::span<const double> ms, double deadlineMs) {
    std::size_t late = 0, settled = ms.size();
    for (std::size_t i = ms.size(); i-- > 0;) {
        late += ms[i] > deadlineMs ? 1 : 0;
        if (20 * late <= ms.size() - i) settled = i;
    }
    return static_cast<int>(settled);
}

double p95(const GovernedRun& run, std::size_t from) {
    std::vector<double> ms;
    for (const GovernedScene& scene : run.scenes)
        ms.insert(ms.end(), scene.ms.begin() + static_cast<long>(std::min(from, scene.ms.size())),
                  scene.ms.end());
    return percentile(std::move(ms), 0.95);
}

namespace {

/// Text about the frames after the settling time; empty if no scene has such frames.
std::string settledText(const GovernedRun& run) {
    const bool any = std::ranges::any_of(
        run.scenes, [](const GovernedScene& scene) { return scene.ms.size() > kSettling; });
    if (!any) return {};
    return fmt::format("; without the first {} frames of each scene, it is {:.1f} ms", kSettling,
                       p95(run, kSettling));
}

}  // namespace

std::string governorTable(std::span<const GovernedRun> runs) {
    std::string out;
    for (const GovernedRun& run : runs) {
        out += fmt::format("deadline {:g} ms: p95 of all frame times is {:.1f} ms{}\n",
                           run.deadlineMs, p95(run, 0), settledText(run));
        out += fmt::format("  {:<10}{:>9}{:>9}{:>7}{:>9}  quality levels (frames)\n", "scene",
                           "med. ms", "p95 ms", "late", "settled");
        for (const GovernedScene& scene : run.scenes)
            out += fmt::format(
                "  {:<10}{:>9.1f}{:>9.1f}{:>7}{:>9} {}\n", scene.name, percentile(scene.ms, 0.5),
                percentile(scene.ms, 0.95),
                std::ranges::count_if(scene.ms, [&](double ms) { return ms > run.deadlineMs; }),
                settledAfter(scene.ms, run.deadlineMs), levelsOf(scene));
    }
    return out;
}

}  // namespace mfar::bench
