#pragma once

#include "pipeline/render/virtual_options.h"
#include "pipeline/track/tag_map.h"

#include <filesystem>
#include <vector>

namespace mfar {

class TomlReader;

inline constexpr std::size_t kMostObjects = 64;

/// Reads the sections [[objects]]: what is shown, and where. Models are read here, so that one that
/// is missing or broken is a fault with its place; their names are relative to `folder`.
void readObjects(TomlReader& file, const std::filesystem::path& folder,
                 std::vector<PlacedObject>& objects);

/// Where an object is. Nothing when it stands on a tag that the map does not have.
[[nodiscard]] std::optional<RigidTransform> worldPlace(const PlacedObject& object,
                                                       const TagMap& tags);

/// The simple shapes among them that have a place, each there.
[[nodiscard]] std::vector<VirtualObject> placedShapes(const std::vector<PlacedObject>& objects,
                                                      const TagMap& tags);

}  // namespace mfar
