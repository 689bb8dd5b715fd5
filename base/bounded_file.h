#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

/// Returns all bytes of a regular file. Devices and named pipes are refused without waiting. A file
/// of more than `most` bytes is refused before memory is allocated. Throws std::runtime_error with
/// the fault, but without the file's name, e.g. "has 9 bytes; the limit is 8 bytes".
[[nodiscard]] std::vector<std::uint8_t> boundedFile(const std::filesystem::path& file,
                                                    std::size_t most);

enum class FileTrust {
    Any,
    /// The file must belong to the user who runs this process, and must not be a symbolic link.
    /// Otherwise the call throws "belongs to another user" or "is a symbolic link".
    OwnFile,
};

[[nodiscard]] std::string boundedText(const std::filesystem::path& file, std::size_t most,
                                      FileTrust trust = FileTrust::Any);

}  // namespace mfar
