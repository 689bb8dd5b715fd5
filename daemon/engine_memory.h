#pragma once

#include "pipeline/engine/engine.h"

#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

/// Returns the path of engines.json, which stores the measured choices of engines. It is in the
/// service's state folder ($STATE_DIRECTORY). Returns an empty path if there is no such folder;
/// then each start measures again.
[[nodiscard]] std::filesystem::path engineMemoryFile();

/// Returns the choice that is stored for `key`, which names the driver and the picture sizes.
/// Returns nothing if no choice is stored or the file is damaged.
[[nodiscard]] std::optional<EngineChoice> rememberedEngines(const std::filesystem::path& file,
                                                            const std::string& key);
/// Stores the choice for `key` and keeps the choices for other keys. Returns false if `file` is
/// empty or cannot be written.
bool rememberEngines(const std::filesystem::path& file, const std::string& key,
                     const EngineChoice& choice);

}  // namespace mfar
