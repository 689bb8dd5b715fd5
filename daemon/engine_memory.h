#pragma once

#include "pipeline/engine/engine.h"

#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

/// File of measured choices: engines.json in the service's state folder ($STATE_DIRECTORY); empty
/// where there is no such folder, so that each start measures again.
[[nodiscard]] std::filesystem::path engineMemoryFile();

/// The choice stored for this driver and these picture sizes; nothing where there is none, or where
/// the file is damaged.
[[nodiscard]] std::optional<EngineChoice> rememberedEngines(const std::filesystem::path& file,
                                                            const std::string& key);
/// Stores a choice; those of other keys stay. False when the file cannot be written.
bool rememberEngines(const std::filesystem::path& file, const std::string& key,
                     const EngineChoice& choice);

}  // namespace mfar
