#pragma once

#include "daemon/limits_config.h"
#include "pipeline/scene/virtual_options.h"

#include <filesystem>

namespace mfar {

class TomlReader;

void readVirtual(TomlReader& file, VirtualOptions& options);

/// Reads section [light]: the light on virtual objects. Also reads an environment picture, so that
/// its fault (missing, invalid, larger than `memory`) is reported with the line of the
/// configuration file that names it. The name is relative to `folder`.
void readLight(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
               LightOptions& light);

}  // namespace mfar
