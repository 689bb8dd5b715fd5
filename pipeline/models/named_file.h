#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mfar {

/// Decodes a relative URI to a file name; for example, %20 becomes a space. Throws
/// std::runtime_error if the encoding is invalid.
[[nodiscard]] std::string percentDecoded(std::string_view uri);

/// Returns the path of the file `name`, to which a document in `folder` refers. The file must be in
/// `folder` or in a folder below. Symbolic links are followed and must not lead outside `folder`.
/// Throws std::runtime_error with the fault.
[[nodiscard]] std::filesystem::path fileInFolder(const std::filesystem::path& folder,
                                                 const std::string& name);

}  // namespace mfar
