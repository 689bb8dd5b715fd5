#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mfar {

/// A relative URI as a name: %20 is a space. Throws std::runtime_error.
[[nodiscard]] std::string percentDecoded(std::string_view uri);

/// The file that a document names in its folder or below; symbolic links are followed and must not
/// lead out of it. Throws std::runtime_error that says what is wrong.
[[nodiscard]] std::filesystem::path fileInFolder(const std::filesystem::path& folder,
                                                 const std::string& name);

}  // namespace mfar
