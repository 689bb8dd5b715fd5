#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace mfar {

/// When written data is safe from a power cut.
enum class Durability {
    OnReturn,
    WithSync,  ///< after the next syncFileSystem(); until then the file may be empty or truncated
};

/// Writes a file that exists either completely or not at all: the bytes go to a temporary file next
/// to it, which is renamed at the end. An existing file is replaced. Thread-safe. Throws
/// std::runtime_error "file: reason", also when the disk is full.
void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    Durability durability = Durability::OnReturn);

/// Makes everything written to this folder's file system safe from a power cut. Throws like
/// writeWholeFile().
void syncFileSystem(const std::filesystem::path& folder);

/// Appends the whole text to a file or nothing; creates a missing file. A power cut before the next
/// syncFileSystem() may leave a part. One thread per file. Throws like writeWholeFile().
void appendToFile(const std::filesystem::path& file, std::string_view text);

}  // namespace mfar
