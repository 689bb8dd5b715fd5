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

/// Reads the sections [[objects]]: what is shown, and where. Models are read here, so that a fault
/// (missing, invalid, `memory` too small) is reported with its place in the file. File names are
/// relative to `folder`.
void readObjects(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
                 std::vector<PlacedObject>& objects);

/// Pose of an object in the world. Empty if it stands on a tag that is not in the map.
[[nodiscard]] std::optional<RigidTransform> worldPlace(const PlacedObject& object,
                                                       const TagMap& tags);

/// The reasons why objects are not shown, a line each: the object stands on a tag that is not in
/// the map, or it is a model and `shapesAlone` gives the reason why no models are shown ("": models
/// are shown).
[[nodiscard]] std::vector<std::string> leftOut(const std::vector<PlacedObject>& objects,
                                               const TagMap& tags, std::string_view shapesAlone);

/// The simple shapes among them that have a place, each there.
[[nodiscard]] std::vector<VirtualObject> placedShapes(const std::vector<PlacedObject>& objects,
                                                      const TagMap& tags);

}  // namespace mfar
