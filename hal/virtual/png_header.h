#pragma once

#include "base/image_view.h"

#include <filesystem>

namespace mfar {

/// Size of a PNG file from its header, without decoding it. The end of the file is looked at too,
/// so a truncated file is found at the cost of two small reads. Throws std::runtime_error whose
/// message says what is wrong without naming the file.
[[nodiscard]] Size pngSize(const std::filesystem::path& file);

}  // namespace mfar
