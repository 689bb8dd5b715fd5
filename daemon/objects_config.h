#pragma once

#include "pipeline/composite/virtual_object.h"

#include <vector>

namespace mfar {

class TomlReader;

inline constexpr std::size_t kMostObjects = 64;

/// Reads the sections [[objects]]: what is shown in the world.
void readObjects(TomlReader& file, std::vector<VirtualObject>& objects);

}  // namespace mfar
