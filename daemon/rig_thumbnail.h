#pragma once

#include "base/image_view.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// A small copy of a picture of any format as a JPEG file, at most 640x480 pixels: at most some
/// hundred kilobytes. Throws std::runtime_error.
[[nodiscard]] std::vector<std::uint8_t> thumbnail(const ImageView& picture);

}  // namespace mfar
