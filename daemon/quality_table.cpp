#include "daemon/quality_table.h"

#include "daemon/config.h"
#include "daemon/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>

namespace mfar {
namespace {

constexpr std::size_t kMostLevels = 64;
constexpr double kShort = 1;
constexpr std::pair<std::string_view, SuperResMode> kModes[] = {
    {"detail", SuperResMode::Detail}, {"blend", SuperResMode::Blend}, {"off", SuperResMode::Off}};

struct LevelKey {
    const char* name;
    int& (*in)(Quality&);
};
constexpr LevelKey kLevelKeys[] = {
    {"depth_every", [](Quality& q) -> int& { return q.depthEvery; }},
    {"flow2d.search_radius", [](Quality& q) -> int& { return q.flow2d.searchRadius; }},
    {"flow2d.candidates", [](Quality& q) -> int& { return q.flow2d.candidates; }},
    {"flow2d.steps", [](Quality& q) -> int& { return q.flow2d.steps; }},
    {"flow2d.propagations", [](Quality& q) -> int& { return q.flow2d.propagations; }},
    {"flow2d.coarsest_propagations",
     [](Quality& q) -> int& { return q.flow2d.coarsestPropagations; }},
    {"flow2d.plane_fits", [](Quality& q) -> int& { return q.flow2d.planeFits; }},
    {"epipolar.window_radius", [](Quality& q) -> int& { return q.epipolar.windowRadius; }},
    {"epipolar.step_penalty", [](Quality& q) -> int& { return q.epipolar.stepPenalty; }},
    {"epipolar.jump_penalty", [](Quality& q) -> int& { return q.epipolar.jumpPenalty; }},
    {"epipolar.finest", [](Quality& q) -> int& { return q.epipolar.finest; }},
    {"epipolar.most_predicted", [](Quality& q) -> int& { return q.epipolar.mostPredicted; }},
};

QualityLevel readLevel(TomlReader& file, const std::string& prefix) {
    QualityLevel out;
    file.text(prefix + "name", out.name);
    file.number(prefix + "ms", out.ms);
    file.number(prefix + "psnr_db", out.psnrDb);
    file.choice<SuperResMode>(prefix + "mode", out.quality.mode, kModes);
    file.boolean(prefix + "cubic", out.quality.cubic);
    file.boolean(prefix + "learned", out.quality.learned);
    file.boolean(prefix + "along_lines", out.quality.alongLines);
    file.number(prefix + "detail_share", out.quality.detailShare);
    file.number(prefix + "second_share", out.quality.secondShare);
    for (const LevelKey& key : kLevelKeys)
        file.integer(prefix + key.name, key.in(out.quality));
    return out;
}

void requireWhole(const std::vector<QualityLevel>& levels, const std::string& file) {
    if (levels.empty())
        throw ConfigError(file + ":1:1: the table of levels has no section [[level]]");
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const auto same = [&](const QualityLevel& other) { return other.name == levels[i].name; };
        if (levels[i].name.empty() || !(levels[i].ms > 0))
            throw ConfigError(fmt::format("{}:1:1: level[{}] needs the keys name and ms", file, i));
        if (std::ranges::count_if(levels, same) > 1)
            throw ConfigError(
                fmt::format("{}:1:1: level \"{}\" occurs twice", file, levels[i].name));
    }
}

// The output of `mfar-bench pareto --table FILE` for the SIMD engine. Only the most accurate level
// uses a second still.
constexpr std::string_view kBuiltInLevels = R"(
[[level]]
name = "off-linear"
ms = 1.0
psnr_db = 26.59
mode = "off"
cubic = false

[[level]]
name = "off"
ms = 1.2
psnr_db = 27.03
mode = "off"

[[level]]
name = "lines-quarter-tiles-5"
ms = 6.9
psnr_db = 27.27
mode = "detail"
detail_share = 0.050
second_share = 0.000
flow2d.plane_fits = 1
epipolar.finest = 2

[[level]]
name = "lines-quarter-tiles-12"
ms = 9.0
psnr_db = 27.40
mode = "detail"
detail_share = 0.120
second_share = 0.000
flow2d.plane_fits = 1
epipolar.finest = 2

[[level]]
name = "lines-half-no-filters"
ms = 14.0
psnr_db = 30.82
mode = "detail"
learned = false
second_share = 0.000
epipolar.finest = 1

[[level]]
name = "no-filters"
ms = 17.0
psnr_db = 31.03
mode = "detail"
learned = false
second_share = 0.000

[[level]]
name = "detail"
ms = 25.4
psnr_db = 31.15
mode = "detail"
)";

}  // namespace

std::vector<QualityLevel> parseQualityLevels(std::string_view toml, const std::string& fileName) {
    TomlReader file(toml, fileName, levelOptions(), "docs/configuration.md");
    std::vector<QualityLevel> out;
    for (const std::string& prefix : file.sections("level", kMostLevels))
        out.push_back(readLevel(file, prefix));
    file.finish();
    requireWhole(out, fileName);
    std::ranges::sort(out, {}, [](const QualityLevel& l) { return std::tie(l.ms, l.name); });
    return out;
}

std::string toToml(std::span<const QualityLevel> levels) {
    std::string out;
    const Quality byDefault;
    for (const QualityLevel& level : levels) {
        Quality quality = level.quality, usual = byDefault;
        std::ostringstream quoted;
        quoted << toml::value<std::string>(level.name);
        // A short time gets more digits. With one digit, it could be rounded to 0, and
        // parseQualityLevels() refuses 0.
        const int digits = level.ms < kShort ? 3 : 1;
        out += fmt::format("[[level]]\nname = {}\nms = {:.{}f}\npsnr_db = {:.2f}\nmode = \"{}\"\n",
                           quoted.str(), level.ms, digits, level.psnrDb, name(quality.mode));
        if (!quality.cubic) out += "cubic = false\n";
        if (!quality.learned) out += "learned = false\n";
        if (!quality.alongLines) out += "along_lines = false\n";
        if (quality.detailShare != usual.detailShare)
            out += fmt::format("detail_share = {:.3f}\n", quality.detailShare);
        if (quality.secondShare != usual.secondShare)
            out += fmt::format("second_share = {:.3f}\n", quality.secondShare);
        for (const LevelKey& key : kLevelKeys)
            if (key.in(quality) != key.in(usual))
                out += fmt::format("{} = {}\n", key.name, key.in(quality));
        out += "\n";
    }
    return out;
}

std::vector<QualityLevel> limitedTo(std::span<const QualityLevel> levels, SuperResMode best) {
    std::vector<QualityLevel> out;
    for (QualityLevel level : levels) {
        if (best != SuperResMode::Detail && level.quality.mode == SuperResMode::Detail)
            level.quality.mode = best;
        if (best == SuperResMode::Off)
            level.quality = {.mode = SuperResMode::Off, .cubic = level.quality.cubic};
        // Only mode "detail" uses `learned` and `secondShare`.
        if (level.quality.mode != SuperResMode::Detail) {
            level.quality.learned = Quality().learned;
            level.quality.secondShare = Quality().secondShare;
        }
        const auto same = [&](const QualityLevel& other) { return other.quality == level.quality; };
        if (std::ranges::none_of(out, same)) out.push_back(level);
    }
    return out;
}

const std::vector<QualityLevel>& builtInQualityLevels() {
    static const std::vector<QualityLevel> levels =
        parseQualityLevels(kBuiltInLevels, "built-in levels");
    return levels;
}

}  // namespace mfar
