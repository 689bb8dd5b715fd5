#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace mfar {

/// When what was written is safe from a cut of power.
enum class Durability {
    OnReturn,
    WithSync,  ///< with the next syncFileSystem(); until then the file may be empty or cut off
};

/// Writes a file that either exists completely or not at all: the bytes go to a temporary name
/// beside it, which is renamed at the end. A file of that name is replaced. May be called from
/// several threads. Throws std::runtime_error "file: reason", also when the disk is full.
void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    Durability durability = Durability::OnReturn);

/// Makes all that was written to the file system of this folder safe from a cut of power. Throws
/// like writeWholeFile().
void syncFileSystem(const std::filesystem::path& folder);

/// Adds text to the end of a file, all of it or nothing; creates the file. A cut of power before
/// the next syncFileSystem() may leave a part. One thread per file.
/// Throws like writeWholeFile().
void appendToFile(const std::filesystem::path& file, std::string_view text);

}  // namespace mfar
