#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>

namespace mfar {

/// Position of one colour in a pixel's little-endian word.
struct PixelChannel {
    int offset = 0, length = 0;  ///< [bit]
    bool operator==(const PixelChannel&) const = default;
};

/// Pixel layout of a memory-mapped screen: 16, 24 or 32 bits, each colour 1 to 8 bits. An alpha
/// channel, if any, is filled with ones (opaque).
struct PixelLayout {
    int bits = 32;
    PixelChannel red{16, 8}, green{8, 8}, blue{0, 8}, alpha{24, 0};
    bool operator==(const PixelLayout&) const = default;

    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bits) / 8; }
    /// True when every channel fits into the word.
    [[nodiscard]] bool valid() const;
};

/// Converts a picture (Rgba8 or Bgra8 with alpha 255) to another layout, keeping each colour's
/// upper bits; output rows are `stride` bytes apart. `layout` must be valid(). Not in place.
void packPixels(const ImageView& picture, const PixelLayout& layout, std::uint8_t* out,
                std::size_t stride);

}  // namespace mfar
