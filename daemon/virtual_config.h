#pragma once

#include "daemon/limits_config.h"
#include "pipeline/scene/virtual_options.h"

#include <filesystem>

namespace mfar {

class TomlReader;

/// Reads section [virtual]: how virtual things are rendered.
void readVirtual(TomlReader& file, VirtualOptions& options);

/// Reads section [light]: what lights them. An environment picture is read here, so that one that
/// is missing or broken, or for which `memory` is too small, is a fault with its place; its name is
/// relative to `folder`.
void readLight(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
               LightOptions& light);

}  // namespace mfar
