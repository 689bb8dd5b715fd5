#pragma once

#include "daemon/quality_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

class TomlReader;

/// Section [governor] of the configuration.
struct GovernorConfig {
    double deadlineMs = 0;        ///< of a frame; 0: nothing is governed
    std::string pin;              ///< name of the level that is always used; empty: none
    std::filesystem::path table;  ///< of levels; empty: the built-in one

    [[nodiscard]] bool governs() const { return pin.empty() && deadlineMs > 0; }
    bool operator==(const GovernorConfig&) const = default;
};

/// Reads section [governor].
void readGovernor(TomlReader& file, GovernorConfig& governor);

/// The levels to choose from; the pinned one alone where one is; none without pin and deadline.
/// Throws ConfigError for a wrong table or a pin that is not in it, Failure(NoInput) when the table
/// cannot be read.
[[nodiscard]] std::vector<QualityLevel> governedLevels(const GovernorConfig& governor);

}  // namespace mfar
