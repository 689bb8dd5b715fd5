#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace mfar {

/// Selects when written data are safe from a power cut.
enum class Durability {
    OnReturn,
    WithSync,  ///< safe after the next syncFileSystem(); until then, a power cut can truncate files
};

/// Writes a file completely or not at all: the bytes go to a temporary file in the same folder,
/// which is renamed at the end. An existing file is replaced. If `file` is a symbolic link, the
/// file to which it leads is replaced. A device or pipe is not replaced; the bytes are written into
/// it. Thread-safe. Throws std::runtime_error "file: reason", also if the disk is full.
void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    Durability durability = Durability::OnReturn);

struct NewFile {
    std::filesystem::path file;
    std::string_view text;
};
/// Writes several files of a folder, each like writeWholeFile(). No file is replaced before the
/// contents of all are on the disk.
void writeWholeFiles(std::span<const NewFile> files);

/// Makes all data on this folder's file system safe from a power cut. Throws like writeWholeFile().
void syncFileSystem(const std::filesystem::path& folder);

/// Appends the text to a file, completely or not at all. A missing file is created. A power cut
/// before the next syncFileSystem() may leave a part of the text. Two threads must not write the
/// same file at the same time. Throws like writeWholeFile().
void appendToFile(const std::filesystem::path& file, std::string_view text);

}  // namespace mfar
