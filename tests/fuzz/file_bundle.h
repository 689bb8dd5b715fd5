#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mfar::test {

/// Files in a folder, from one input: "#@ NAME", a line end and the file's bytes, up to the line
/// end before the next such line or to the input's end. The names are those of `known`; what has
/// another name is left out. The folder is in memory where the machine has such a one, and is
/// removed.
class FileBundle {
public:
    FileBundle(const std::uint8_t* data, std::size_t size, const std::vector<std::string>& known);
    FileBundle(const FileBundle&) = delete;
    FileBundle& operator=(const FileBundle&) = delete;
    ~FileBundle();

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// In the order of the input.
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> files_;
};

}  // namespace mfar::test
