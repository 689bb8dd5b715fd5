#pragma once

#include "base/image_view.h"

#include <filesystem>

namespace mfar {

/// Reads a picture's size from the header of a PNG file. Also reads the last bytes, to detect a
/// truncated file. Throws std::runtime_error whose message names the fault but not the file.
[[nodiscard]] Size pngSize(const std::filesystem::path& file);

}  // namespace mfar
