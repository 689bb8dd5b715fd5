#pragma once

#include "daemon/cameras_config.h"

#include <filesystem>
#include <optional>

namespace mfar {

/// Where the service keeps what it has taken, until it ends or, after a crash, its hook has
/// released it ($RUNTIME_DIRECTORY); empty where no service manager has made the folder.
[[nodiscard]] std::filesystem::path takenLineFile();

/// Notes the line for whoever comes after a crash: three lines "chip=", "line=" and "active_low=".
/// Throws std::runtime_error.
void noteTakenLine(const std::filesystem::path& file, const TriggerLineConfig& line);

/// The line that was noted there; nothing where there is no such file. Only a short regular file of
/// this user with exactly these three keys is read, and no link is followed. Throws
/// Failure(BadData).
[[nodiscard]] std::optional<TriggerLineConfig> takenLine(const std::filesystem::path& file);

}  // namespace mfar
