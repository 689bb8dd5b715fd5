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

/// Writes a file completely or not at all: the bytes go to a temporary file in the same folder, and
/// this temporary file is renamed at the end. An existing file is replaced. If `file` is a symbolic
/// link to an existing file, that file is replaced; a link to a missing file is replaced itself. A
/// device or pipe is not replaced; the bytes are written into it, and after an error a part of them
/// may be written. Thread-safe. Throws std::runtime_error "file: reason", also if the disk is full.
void writeWholeFile(const std::filesystem::path& file, std::span<const std::uint8_t> bytes,
                    Durability durability = Durability::OnReturn);
/// The same for a text.
void writeWholeFile(const std::filesystem::path& file, std::string_view text,
                    Durability durability = Durability::OnReturn);

struct NewFile {
    std::filesystem::path file;
    std::string_view text;
};
/// Writes several files with Durability::OnReturn. No file is replaced before the contents of all
/// are on the disk. Symbolic links are treated as by writeWholeFile(). Exception: if a name leads
/// to a device or pipe, directly or through a link, the new file replaces the device or the link.
/// Throws like writeWholeFile(); then some of the files may already be replaced.
void writeWholeFiles(std::span<const NewFile> files);

/// Makes all data on this folder's file system safe from a power cut. Throws like writeWholeFile().
void syncFileSystem(const std::filesystem::path& folder);

/// Appends the text to a file. After a write error, the part that was written is removed again. A
/// missing file is created. A power cut before the next syncFileSystem() may leave a part of the
/// text. Two threads must not write the same file at the same time. Throws like writeWholeFile().
void appendToFile(const std::filesystem::path& file, std::string_view text);

}  // namespace mfar
