#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar {

/// All bytes of a regular file. A device or a named pipe is refused without being waited for, and a
/// file that is too large before memory is taken for it. Throws std::runtime_error whose message
/// says what is wrong without naming the file: "is missing", "is not a regular file", "cannot be
/// opened: reason", "has 9 bytes, at most 8 are read", "has become longer while it was read".
[[nodiscard]] std::vector<std::uint8_t> boundedFile(const std::filesystem::path& file,
                                                    std::size_t most);

enum class FileTrust {
    Any,
    OwnFile,  ///< owned by this user and not a symbolic link, or throws "is a symbolic link" or "is
              ///< another user's"
};

/// As boundedFile(), returned as text.
[[nodiscard]] std::string boundedText(const std::filesystem::path& file, std::size_t most,
                                      FileTrust trust = FileTrust::Any);

}  // namespace mfar
