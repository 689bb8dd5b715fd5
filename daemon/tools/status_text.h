#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace mfar {

/// Returns mfard's answer to a command as text, with a line "key value" for each value. The health
/// is one line. Each camera has a line, with those of its counters that are not 0. A missing value
/// is "none".
[[nodiscard]] std::string statusText(const nlohmann::ordered_json& answer);

}  // namespace mfar
