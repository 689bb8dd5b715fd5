#pragma once

#include "daemon/quality_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

class TomlReader;

struct GovernorConfig {
    double deadlineMs = 0;  ///< 0: there is no governor
    std::string pin;
    std::filesystem::path table;

    [[nodiscard]] bool governs() const { return pin.empty() && deadlineMs > 0; }
    bool operator==(const GovernorConfig&) const = default;
};

void readGovernor(TomlReader& file, GovernorConfig& governor);

/// Returns the levels of the configured table, or the built-in levels if no table is configured.
/// Returns an empty list if there is neither a pinned level nor a deadline. Throws ConfigError if
/// the table is invalid, and Failure(NoInput) if it cannot be read.
[[nodiscard]] std::vector<QualityLevel> knownLevels(const GovernorConfig& governor);

/// Returns the levels among which the governor chooses. If a level is pinned, returns only that
/// level. Throws ConfigError if the table lacks the pinned level, and the errors of knownLevels().
[[nodiscard]] std::vector<QualityLevel> governedLevels(const GovernorConfig& governor);

}  // namespace mfar
