#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace mfar {

/// Parses a YAML text. Throws YAML::Exception if the text is not valid, has aliases, is nested
/// deeper than 16 levels or has more than 50000 values. Keys, lists and maps count as values. No
/// calibration file reaches these limits.
/// The limits are checked before the tree of values is built.
[[nodiscard]] YAML::Node boundedYaml(const std::string& text);

}  // namespace mfar
