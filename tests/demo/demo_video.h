#pragma once

#include <filesystem>

namespace mfar::demo {

/// Converts a Y4M file (4:2:0, BT.601) to a Motion JPEG AVI of half its width and height, for any
/// player. Throws std::runtime_error that names the file.
void writeVideo(const std::filesystem::path& y4m, const std::filesystem::path& avi);

}  // namespace mfar::demo
