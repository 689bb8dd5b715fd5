#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace mfar {

/// The tree of a YAML text. Throws YAML::Exception for what the library finds wrong, and for more
/// than any file of ours has: aliases, values in values deeper than 16, more than 100000 values.
/// All of it is found before a tree is built.
[[nodiscard]] YAML::Node boundedYaml(const std::string& text);

}  // namespace mfar
