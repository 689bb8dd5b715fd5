#pragma once

#include "pipeline/engine/engine.h"

#include <filesystem>
#include <optional>
#include <string>

namespace mfar {

/// Where measured choices are kept: engines.json in the service's state folder ($STATE_DIRECTORY);
/// empty where there is none, then each start measures anew.
[[nodiscard]] std::filesystem::path engineMemoryFile();

/// The choice that was kept for this driver and these picture sizes; nothing where there is none,
/// or where the file is damaged.
[[nodiscard]] std::optional<EngineChoice> rememberedEngines(const std::filesystem::path& file,
                                                            const std::string& key);
/// Keeps a choice beside those of other keys. False where it cannot be written.
bool rememberEngines(const std::filesystem::path& file, const std::string& key,
                     const EngineChoice& choice);

}  // namespace mfar
