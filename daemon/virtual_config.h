#pragma once

#include "daemon/limits_config.h"
#include "pipeline/scene/virtual_options.h"

#include <filesystem>

namespace mfar {

class TomlReader;

/// Reads section [virtual]: how virtual objects are rendered.
void readVirtual(TomlReader& file, VirtualOptions& options);

/// Reads section [light]: what lights them. An environment picture is read here, so that a fault
/// (missing, invalid, `memory` too small) is reported with its place in the file; its name is
/// relative to `folder`.
void readLight(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
               LightOptions& light);

}  // namespace mfar
