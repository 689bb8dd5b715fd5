#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

/// Short names for recordings: the folder's name, or the whole path if the name is not unique.
[[nodiscard]] std::vector<std::string> labelsOf(const std::vector<std::filesystem::path>& paths);

}  // namespace mfar::eval
