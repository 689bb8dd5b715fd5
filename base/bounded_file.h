#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

/// Returns all bytes of a regular file. Devices and named pipes are refused at once, without
/// waiting. A file of more than `most` bytes is refused before memory is allocated. Throws
/// std::runtime_error. The message names the fault but not the file: "is missing", "is not a
/// regular file", "cannot be opened: reason", "has 9 bytes; the limit is 8 bytes", "became longer
/// while it was read".
[[nodiscard]] std::vector<std::uint8_t> boundedFile(const std::filesystem::path& file,
                                                    std::size_t most);

enum class FileTrust {
    Any,
    /// The file must belong to this user and must not be a symbolic link. Otherwise the call throws
    /// "belongs to another user" or "is a symbolic link".
    OwnFile,
};

/// Like boundedFile(), but returns the content as text.
[[nodiscard]] std::string boundedText(const std::filesystem::path& file, std::size_t most,
                                      FileTrust trust = FileTrust::Any);

}  // namespace mfar
