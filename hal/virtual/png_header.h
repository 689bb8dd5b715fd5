#pragma once

#include "base/image_view.h"

#include <filesystem>

namespace mfar {

/// Reads the size of a PNG file from its header without decoding it. Also checks the end of the
/// file, so two small reads detect a truncated file. Throws std::runtime_error whose message states
/// the fault without naming the file.
[[nodiscard]] Size pngSize(const std::filesystem::path& file);

}  // namespace mfar
