#pragma once

#include "base/image_view.h"

#include <cstdint>
#include <vector>

namespace mfar {

/// Makes a JPEG file of a picture of any format, reduced to at most 640x480 pixels. The file has a
/// few hundred kilobytes at most. Throws std::runtime_error.
[[nodiscard]] std::vector<std::uint8_t> thumbnail(const ImageView& picture);

}  // namespace mfar
