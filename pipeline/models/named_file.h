#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mfar {

/// Decodes a relative URI to a file name; %20 becomes a space. Throws std::runtime_error.
[[nodiscard]] std::string percentDecoded(std::string_view uri);

/// The file to which a document refers. It must be in this folder or below. Symbolic links are
/// followed and must not lead outside. Throws std::runtime_error with the fault.
[[nodiscard]] std::filesystem::path fileInFolder(const std::filesystem::path& folder,
                                                 const std::string& name);

}  // namespace mfar
