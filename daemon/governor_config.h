#pragma once

#include "daemon/quality_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

class TomlReader;

/// Section [governor] of the configuration.
struct GovernorConfig {
    double deadlineMs = 0;        ///< of a frame; 0: no governor
    std::string pin;              ///< name of the level to use always; empty: no pin
    std::filesystem::path table;  ///< file of levels; empty: the built-in table

    [[nodiscard]] bool governs() const { return pin.empty() && deadlineMs > 0; }
    bool operator==(const GovernorConfig&) const = default;
};

/// Reads section [governor].
void readGovernor(TomlReader& file, GovernorConfig& governor);

/// The levels to choose from: the pinned level, if one is configured; empty without pin and
/// deadline. Throws ConfigError for an invalid table or a pin that is not in it, Failure(NoInput)
/// when the table cannot be read.
[[nodiscard]] std::vector<QualityLevel> governedLevels(const GovernorConfig& governor);

}  // namespace mfar
