#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Destination of a decoded picture: address of the first row and stride [bytes], for pixels with
/// bytes R G B A. TargetOf gets the picture's size and returns the destination. It may throw.
struct PixelTarget {
    std::uint8_t* rgba;
    std::size_t stride;
};
using TargetOf = std::function<PixelTarget(Size size)>;

enum class ImageAlpha : std::uint8_t {
    Opaque,  ///< alpha is 255
    Kept,    ///< alpha comes from the file; 255 if the file has no alpha
};

/// Returns true if a file begins like a PNG or a JPEG.
[[nodiscard]] bool isPngOrJpeg(std::span<const std::uint8_t> file);

/// Decodes a PNG or JPEG to RGBA. 16-bit values are reduced to their upper 8 bits. Throws
/// std::runtime_error if the file is damaged, is neither a PNG nor a JPEG, is a JPEG with CMYK
/// colours, or is a progressive JPEG of more than 2^24 pixels.
void decodeImage(std::span<const std::uint8_t> file, const TargetOf& targetOf,
                 ImageAlpha alpha = ImageAlpha::Opaque);

/// Order of a pixel's bytes in memory; X is ignored.
enum class PixelBytes : std::uint8_t { Grey, Bgr, Rgbx, Bgrx };

/// Encodes a picture as PNG, optimised for speed and not for size. Replaces the content of `out`.
/// Throws std::runtime_error.
void encodePng(const std::uint8_t* pixels, std::size_t stride, Size size, PixelBytes format,
               std::vector<std::uint8_t>& out);

/// `quality` is from 1 to 100. Throws std::runtime_error.
[[nodiscard]] std::vector<std::uint8_t> encodeJpeg(const std::uint8_t* pixels, std::size_t stride,
                                                   Size size, PixelBytes format, int quality);

}  // namespace mfar
