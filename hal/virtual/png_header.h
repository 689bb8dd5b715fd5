#pragma once

#include "base/image_view.h"

#include <filesystem>

namespace mfar {

/// Reads a picture's size from the header of a PNG file, without decoding the file. Also reads the
/// last bytes of the file, to detect a truncated file. Throws a std::runtime_error whose message
/// names the fault but not the file.
[[nodiscard]] Size pngSize(const std::filesystem::path& file);

}  // namespace mfar
