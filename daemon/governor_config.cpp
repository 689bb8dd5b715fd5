#include "daemon/governor_config.h"

#include "daemon/config.h"
#include "daemon/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace mfar {
namespace {

std::string namesOf(const std::vector<QualityLevel>& levels) {
    std::string out;
    for (const QualityLevel& level : levels)
        out += (out.empty() ? "\"" : ", \"") + level.name + "\"";
    return out;
}

}  // namespace

void readGovernor(TomlReader& file, GovernorConfig& governor) {
    file.number("governor.deadline_ms", governor.deadlineMs);
    file.text("governor.pin", governor.pin);
    std::string table;
    file.text("governor.table", table);
    governor.table = table;
}

std::vector<QualityLevel> knownLevels(const GovernorConfig& governor) {
    // The table is read even if no level is used, so that a fault in it is always reported.
    std::vector<QualityLevel> levels =
        governor.table.empty()
            ? builtInQualityLevels()
            : parseQualityLevels(readConfigText(governor.table), governor.table.string());
    if (!governor.governs() && governor.pin.empty()) return {};
    return levels;
}

std::vector<QualityLevel> governedLevels(const GovernorConfig& governor) {
    std::vector<QualityLevel> all = knownLevels(governor);
    if (governor.pin.empty()) return all;
    const auto pinned = std::ranges::find(all, governor.pin, &QualityLevel::name);
    if (pinned == all.end())
        throw ConfigError(
            fmt::format("unknown level \"{}\"; known levels: {}", governor.pin, namesOf(all)));
    return {*pinned};
}

}  // namespace mfar
