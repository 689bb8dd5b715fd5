#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Where a decoded picture goes: told its size, gives its first row and the bytes from one row to
/// the next, of R G B A. May throw.
struct PixelTarget {
    std::uint8_t* rgba;
    std::size_t stride;
};
using TargetOf = std::function<PixelTarget(Size size)>;

enum class ImageAlpha : std::uint8_t {
    Opaque,  ///< 255 everywhere
    Kept,    ///< the file's; 255 where it has none
};

/// Decodes a PNG (any colour type and depth, the upper 8 of 16 bits) or a JPEG (grey or colour) as
/// RGBA. Throws std::runtime_error that says what is wrong, also for a file that ends too early and
/// for a progressive JPEG of more than 2^24 pixels, which takes more memory than its picture.
void decodeImage(std::span<const std::uint8_t> file, const TargetOf& targetOf,
                 ImageAlpha alpha = ImageAlpha::Opaque);

/// Bytes of a pixel in memory; X is left out.
enum class PngPixels : std::uint8_t { Grey, Bgr, Rgbx, Bgrx };

/// Encodes a picture as PNG, in grey or in colours without alpha, quickly rather than small. `out`
/// is replaced. Throws std::runtime_error.
void encodePng(const std::uint8_t* pixels, std::size_t stride, Size size, PngPixels format,
               std::vector<std::uint8_t>& out);

}  // namespace mfar
