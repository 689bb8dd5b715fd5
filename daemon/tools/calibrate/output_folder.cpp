#include "daemon/tools/calibrate/output_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <unistd.h>

#include <cerrno>
#include <ranges>
#include <stdexcept>

namespace mfar::calibration {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const fs::path& folder) {
    fs::path part;
    for (const fs::path& name : fs::absolute(folder)) {
        part /= name;
        std::error_code error;
        if (fs::create_directory(part, error)) created_.push_back(part);
        if (!error) continue;
        removeEmpty();
        if (error == std::errc::file_exists)
            error = std::make_error_code(std::errc::not_a_directory);
        throw std::runtime_error(
            fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
    }
    if (access(folder.c_str(), W_OK | X_OK) == 0) return;
    const int error = errno;
    removeEmpty();
    throw std::runtime_error(fmt::format("{}: cannot be written to: {}", folder.string(),
                                         std::generic_category().message(error)));
}

OutputFolder::~OutputFolder() {
    removeEmpty();
}

void OutputFolder::removeEmpty() {
    std::error_code ignored;
    for (const fs::path& folder : created_ | std::views::reverse)
        fs::remove(folder, ignored);
}

}  // namespace mfar::calibration
