#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>

namespace mfar {

/// Where one colour of a pixel lies in its little-endian word.
struct PixelChannel {
    int offset = 0, length = 0;  ///< [bit]
    bool operator==(const PixelChannel&) const = default;
};

/// A pixel of a memory-mapped screen: 16, 24 or 32 bits, each colour 1 to 8 of them. An alpha
/// channel, where there is one, is filled with ones (opaque).
struct PixelLayout {
    int bits = 32;
    PixelChannel red{16, 8}, green{8, 8}, blue{0, 8}, alpha{24, 0};
    bool operator==(const PixelLayout&) const = default;

    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bits) / 8; }
    /// True when every channel has its place in the word.
    [[nodiscard]] bool valid() const;
};

/// Writes a picture, Rgba8 or Bgra8 with alpha 255, in another layout, the uppermost bits of each
/// colour; row after row, `stride` bytes apart. `layout` must be valid(). Not in place.
void packPixels(const ImageView& picture, const PixelLayout& layout, std::uint8_t* out,
                std::size_t stride);

}  // namespace mfar
