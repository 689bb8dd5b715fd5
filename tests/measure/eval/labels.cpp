#include "tests/measure/eval/labels.h"

#include <algorithm>

namespace mfar::eval {

std::vector<std::string> labelsOf(const std::vector<std::filesystem::path>& paths) {
    std::vector<std::string> names;
    for (const auto& path : paths) {
        const auto clean = std::filesystem::absolute(path).lexically_normal();
        names.push_back((clean.has_filename() ? clean : clean.parent_path()).filename().string());
    }
    std::vector<std::string> out;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const bool unique = std::count(names.begin(), names.end(), names[i]) == 1;
        out.push_back(unique ? names[i] : paths[i].string());
    }
    return out;
}

}  // namespace mfar::eval
