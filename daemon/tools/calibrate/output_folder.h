#pragma once

#include <filesystem>
#include <vector>

namespace mfar::calibration {

/// A folder for results that are written later. It is created at once, so that a wrong path is
/// noticed before the results are computed. The destructor removes those of the created folders
/// that are still empty.
class OutputFolder {
public:
    /// Throws std::runtime_error ("folder: cannot be created: reason" or "folder: cannot be written
    /// to: reason").
    explicit OutputFolder(const std::filesystem::path& folder);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

private:
    void removeEmpty();

    std::vector<std::filesystem::path> created_;
};

}  // namespace mfar::calibration
