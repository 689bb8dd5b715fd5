#pragma once

#include "daemon/cameras_config.h"

#include <filesystem>
#include <optional>

namespace mfar {

/// Returns the path of the file in which the service notes the GPIO line before it requests it.
/// After a crash, the service's stop hook reads the file to release the line. The file is in
/// $RUNTIME_DIRECTORY, which systemd deletes when the service has ended. Returns an empty path if
/// this variable is not an absolute path.
[[nodiscard]] std::filesystem::path takenLineFile();

/// Writes the file of takenLineFile(), with the three lines "chip=", "line=" and "active_low=".
/// Throws std::runtime_error.
void noteTakenLine(const std::filesystem::path& file, const TriggerLineConfig& line);

/// Returns the GPIO line that the file names, or nothing if there is no file. Throws
/// Failure(BadData) if the file is too long, is owned by another user, or is not a regular file (a
/// symbolic link is refused, too). Also throws Failure(BadData) if the file does not consist of
/// exactly the three lines that noteTakenLine() writes, with valid values.
[[nodiscard]] std::optional<TriggerLineConfig> takenLine(const std::filesystem::path& file);

}  // namespace mfar
