#pragma once

#include "daemon/limits_config.h"
#include "pipeline/scene/virtual_options.h"

#include <filesystem>

namespace mfar {

class TomlReader;

void readVirtual(TomlReader& file, VirtualOptions& options);

/// Reads section [light]: the light on virtual objects. If the section names an environment
/// picture, reads that file, too. If the picture is missing, invalid or larger than `memory`, this
/// is reported with the line of the configuration that names it. The name is relative to `folder`.
void readLight(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
               LightOptions& light);

}  // namespace mfar
