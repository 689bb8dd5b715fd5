#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>

namespace mfar {

/// The position of one colour in the little-endian word of a screen's pixel: its lowest bit and its
/// number of bits.
struct PixelChannel {
    int offset = 0, length = 0;
    bool operator==(const PixelChannel&) const = default;
};

/// The pixel layout of a memory-mapped screen: 16, 24 or 32 bits per pixel, 1 to 8 bits per colour.
/// An alpha channel is filled with ones (opaque).
struct PixelLayout {
    int bits = 32;
    PixelChannel red{16, 8}, green{8, 8}, blue{0, 8}, alpha{24, 0};
    bool operator==(const PixelLayout&) const = default;

    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bits) / 8; }
    [[nodiscard]] bool valid() const;
};

/// Converts a picture (Rgba8 or Bgra8) to the pixel layout of a screen, keeping the upper bits of
/// each colour. `stride` [bytes] is that of `out`. `layout` must be valid(). `out` must not overlap
/// the picture.
void packPixels(const ImageView& picture, const PixelLayout& layout, std::uint8_t* out,
                std::size_t stride);

}  // namespace mfar
