#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mfar::eval {

/// Short names for recordings: the name of the folder, or its whole path if two folders have the
/// same name.
[[nodiscard]] std::vector<std::string> labelsOf(const std::vector<std::filesystem::path>& paths);

}  // namespace mfar::eval
