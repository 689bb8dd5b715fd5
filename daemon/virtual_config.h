#pragma once

#include "daemon/limits_config.h"
#include "pipeline/scene/virtual_options.h"

#include <filesystem>

namespace mfar {

class TomlReader;

/// Reads section [virtual], which states how virtual objects are rendered.
void readVirtual(TomlReader& file, VirtualOptions& options);

/// Reads section [light], which states the light on virtual objects. An environment picture is read
/// here, too, so that its fault (missing, invalid, larger than `memory`) is reported with the line
/// of the configuration file that names it. The name is relative to `folder`.
void readLight(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
               LightOptions& light);

}  // namespace mfar
