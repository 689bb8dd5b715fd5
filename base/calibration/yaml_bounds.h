#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace mfar {

/// Parses a YAML text. Throws YAML::Exception for errors that the library finds and for aliases,
/// nesting deeper than 16 or more than 100000 values, which no file of this project has. All limits
/// are checked before the tree is built.
[[nodiscard]] YAML::Node boundedYaml(const std::string& text);

}  // namespace mfar
