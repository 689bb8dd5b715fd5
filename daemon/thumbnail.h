#pragma once

#include "base/image_view.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Makes a small copy of a picture of any format as a JPEG file. It has at most 640x480 pixels, and
/// some hundred kilobytes at most. Throws std::runtime_error.
[[nodiscard]] std::vector<std::uint8_t> thumbnail(const ImageView& picture);

}  // namespace mfar
