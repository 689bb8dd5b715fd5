#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace mfar {

/// Returns mfard's answer to a command as lines "key value". `health` is one sentence. `cameras`
/// has a line for each camera, with those counters that are not 0. A missing value is "none".
[[nodiscard]] std::string statusText(const nlohmann::ordered_json& answer);

}  // namespace mfar
