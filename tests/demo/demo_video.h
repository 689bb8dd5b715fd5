#pragma once

#include <filesystem>

namespace mfar::demo {

/// Converts a Y4M file (4:2:0, BT.601) to a Motion JPEG AVI of half its width and height, a format
/// that every player can show. Throws std::runtime_error that names the faulty file.
void writeVideo(const std::filesystem::path& y4m, const std::filesystem::path& avi);

}  // namespace mfar::demo
