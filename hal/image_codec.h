#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Target of a decoded picture: a callback gets the size and returns the first row and the stride
/// in bytes, for pixels R G B A. May throw.
struct PixelTarget {
    std::uint8_t* rgba;
    std::size_t stride;
};
using TargetOf = std::function<PixelTarget(Size size)>;

enum class ImageAlpha : std::uint8_t {
    Opaque,  ///< 255 everywhere
    Kept,    ///< the file's alpha; 255 if it has none
};

/// Decodes a PNG (any colour type and depth; of 16 bits the upper 8) or a JPEG (grey or colour) as
/// RGBA. Throws std::runtime_error with the reason, also for a truncated file and for a progressive
/// JPEG of more than 2^24 pixels, whose decoding takes more memory than the picture.
void decodeImage(std::span<const std::uint8_t> file, const TargetOf& targetOf,
                 ImageAlpha alpha = ImageAlpha::Opaque);

/// Bytes of a pixel in memory; X is ignored.
enum class PixelBytes : std::uint8_t { Grey, Bgr, Rgbx, Bgrx };

/// Encodes a picture as PNG, in grey or in colour without alpha; optimised for speed, not size.
/// `out` is replaced. Throws std::runtime_error.
void encodePng(const std::uint8_t* pixels, std::size_t stride, Size size, PixelBytes format,
               std::vector<std::uint8_t>& out);

/// Encodes a picture as JPEG, in grey or in colour; quality 1 to 100. Throws std::runtime_error.
[[nodiscard]] std::vector<std::uint8_t> encodeJpeg(const std::uint8_t* pixels, std::size_t stride,
                                                   Size size, PixelBytes format, int quality);

}  // namespace mfar
