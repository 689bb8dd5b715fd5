#pragma once

#include "daemon/cameras_config.h"

#include <filesystem>
#include <optional>

namespace mfar {

/// File in which the service notes the line it has taken, until it ends or, after a crash, its hook
/// has released the line ($RUNTIME_DIRECTORY); empty where no service manager has created the
/// folder.
[[nodiscard]] std::filesystem::path takenLineFile();

/// Writes the note: three lines "chip=", "line=" and "active_low=". Throws std::runtime_error.
void noteTakenLine(const std::filesystem::path& file, const TriggerLineConfig& line);

/// The noted line; nothing without a note. Reads only a short regular file of this user with
/// exactly these three keys, and follows no link. Throws Failure(BadData).
[[nodiscard]] std::optional<TriggerLineConfig> takenLine(const std::filesystem::path& file);

}  // namespace mfar
