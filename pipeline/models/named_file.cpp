#include "pipeline/models/named_file.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string>

namespace mfar {

namespace fs = std::filesystem;

std::string percentDecoded(std::string_view uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            out += uri[i];
            continue;
        }
        const std::string_view digits = uri.substr(i + 1, 2);
        unsigned value = 0;
        const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
        if (digits.size() != 2 || end.ptr != digits.data() + 2)
            throw std::runtime_error("the percent-encoding of the file name is invalid");
        out += static_cast<char>(value);
        i += 2;
    }
    return out;
}

fs::path fileInFolder(const fs::path& folder, const std::string& name) {
    if (folder.empty()) throw std::runtime_error("references to other files are not allowed here");
    const fs::path path(name);
    const bool up = std::find(path.begin(), path.end(), fs::path("..")) != path.end();
    if (name.empty() || name.find('\0') != std::string::npos || path.is_absolute() || up)
        throw std::runtime_error("must be a file in the model's folder");
    std::error_code error;
    const fs::path top = fs::canonical(folder, error);
    const fs::path file = error ? fs::path() : fs::canonical(top / path, error);
    if (error) throw std::runtime_error("is missing");
    if (std::mismatch(top.begin(), top.end(), file.begin(), file.end()).first != top.end())
        throw std::runtime_error("must be a file in the model's folder");
    return file;
}

}  // namespace mfar
