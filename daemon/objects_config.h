#pragma once

#include "daemon/limits_config.h"
#include "pipeline/scene/virtual_options.h"
#include "pipeline/track/tag_map.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mfar {

class TomlReader;

inline constexpr std::size_t kMostObjects = 64;

/// Reads the sections [[objects]]: what is shown, and where. Models are read here, so that one that
/// is missing or broken, or for which `memory` is too small, is a fault with its place; their names
/// are relative to `folder`.
void readObjects(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
                 std::vector<PlacedObject>& objects);

/// Where an object is. Nothing when it stands on a tag that the map does not have.
[[nodiscard]] std::optional<RigidTransform> worldPlace(const PlacedObject& object,
                                                       const TagMap& tags);

/// Why what is not shown is not, a line each: it stands on a tag that the map does not have, or it
/// is a model and `shapesAlone` says why there are none ("" : models are shown).
[[nodiscard]] std::vector<std::string> leftOut(const std::vector<PlacedObject>& objects,
                                               const TagMap& tags, std::string_view shapesAlone);

/// The simple shapes among them that have a place, each there.
[[nodiscard]] std::vector<VirtualObject> placedShapes(const std::vector<PlacedObject>& objects,
                                                      const TagMap& tags);

}  // namespace mfar
