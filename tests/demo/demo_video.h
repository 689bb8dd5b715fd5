#pragma once

#include <filesystem>

namespace mfar::demo {

/// Turns a Y4M file (4:2:0, BT.601) into a Motion JPEG AVI of half its width and height, which
/// any player opens. Throws std::runtime_error naming the file.
void writeVideo(const std::filesystem::path& y4m, const std::filesystem::path& avi);

}  // namespace mfar::demo
