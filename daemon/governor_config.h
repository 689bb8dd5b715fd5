#pragma once

#include "daemon/quality_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

class TomlReader;

/// Section [governor] of the configuration.
struct GovernorConfig {
    double deadlineMs = 0;        ///< deadline of a frame [ms]; 0: there is no governor
    std::string pin;              ///< name of a level that is always used; empty: none
    std::filesystem::path table;  ///< file with the levels; empty: the built-in table

    [[nodiscard]] bool governs() const { return pin.empty() && deadlineMs > 0; }
    bool operator==(const GovernorConfig&) const = default;
};

void readGovernor(TomlReader& file, GovernorConfig& governor);

/// Returns the levels among which the governor chooses. If a level is pinned, returns only that
/// one. Returns an empty list if there is neither a pinned level nor a deadline. Throws ConfigError
/// if the table is invalid or does not contain the pinned level, and Failure(NoInput) if the table
/// cannot be read.
[[nodiscard]] std::vector<QualityLevel> governedLevels(const GovernorConfig& governor);

}  // namespace mfar
