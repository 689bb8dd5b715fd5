#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar::test {

/// A folder of files, made from one input. A file begins with a line "#@ NAME", followed by its
/// bytes. It ends before the newline that precedes the next such line, or at the end of the input.
/// Only files with names in `known` are written. The folder is in /dev/shm if that exists. The
/// destructor removes it.
class FileBundle {
public:
    FileBundle(const std::uint8_t* data, std::size_t size, const std::vector<std::string>& known);
    FileBundle(const FileBundle&) = delete;
    FileBundle& operator=(const FileBundle&) = delete;
    ~FileBundle();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
};

}  // namespace mfar::test
