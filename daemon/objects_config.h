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

/// Reads the sections [[objects]] of the configuration, and the model files that they name. If a
/// model is missing, invalid or larger than `memory`, this is reported with the line of the
/// configuration that names the model. File names are relative to `folder`. Adds a note for each
/// key without effect to `notes`.
void readObjects(TomlReader& file, const std::filesystem::path& folder, FileMemory& memory,
                 std::vector<PlacedObject>& objects, std::vector<std::string>& notes);

/// Returns the pose of an object's anchor in the world. The object's position and orientation are
/// relative to this anchor. For an object on a tag, the anchor is at the tag: x points right and y
/// up in the tag's print, z out of it. For other objects, the anchor is the world frame. Returns
/// nothing if the tag is not in the map.
[[nodiscard]] std::optional<RigidTransform> worldAnchor(const PlacedObject& object,
                                                        const TagMap& tags);
[[nodiscard]] std::optional<RigidTransform> worldPlace(const PlacedObject& object,
                                                       const TagMap& tags);

/// Returns one message for each object that is not shown, because its tag is not in the map, or
/// because it is a model and models are not shown. `shapesAlone` is the reason why models are not
/// shown. It is empty if they are shown.
[[nodiscard]] std::vector<std::string> leftOut(const std::vector<PlacedObject>& objects,
                                               const TagMap& tags, std::string_view shapesAlone);

/// Returns one message for each part of the objects' models that is not shown. A model that several
/// objects show is reported once.
[[nodiscard]] std::vector<std::string> modelNotes(const std::vector<PlacedObject>& objects);

/// Returns the simple shapes among the objects, with their poses in the world. Shapes whose tag is
/// not in the map are skipped.
[[nodiscard]] std::vector<VirtualObject> placedShapes(const std::vector<PlacedObject>& objects,
                                                      const TagMap& tags);

}  // namespace mfar
