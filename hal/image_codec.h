#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Where a decoded picture is written: address of the first row and stride [bytes], for pixels with
/// bytes R G B A. A function TargetOf gets the picture's size and returns the PixelTarget. It may
/// throw.
struct PixelTarget {
    std::uint8_t* rgba;
    std::size_t stride;
};
using TargetOf = std::function<PixelTarget(Size size)>;

enum class ImageAlpha : std::uint8_t {
    Opaque,  ///< alpha is 255 everywhere
    Kept,    ///< alpha comes from the file; it is 255 if the file has no alpha
};

/// Decodes a PNG (any colour type and depth) or a JPEG (grey or colour) to RGBA. 16-bit values are
/// reduced to their upper 8 bits. Throws std::runtime_error with the reason, also for a truncated
/// file. A progressive JPEG of more than 2^24 pixels is refused, because its decoding needs more
/// memory than the picture.
void decodeImage(std::span<const std::uint8_t> file, const TargetOf& targetOf,
                 ImageAlpha alpha = ImageAlpha::Opaque);

/// The order of a pixel's bytes in memory; X is ignored.
enum class PixelBytes : std::uint8_t { Grey, Bgr, Rgbx, Bgrx };

/// Encodes a picture as PNG, in grey or in colour without alpha. The encoder is optimised for
/// speed, not for size. The content of `out` is replaced. Throws std::runtime_error.
void encodePng(const std::uint8_t* pixels, std::size_t stride, Size size, PixelBytes format,
               std::vector<std::uint8_t>& out);

/// Encodes a picture as JPEG, in grey or in colour. `quality` is from 1 to 100. Throws
/// std::runtime_error.
[[nodiscard]] std::vector<std::uint8_t> encodeJpeg(const std::uint8_t* pixels, std::size_t stride,
                                                   Size size, PixelBytes format, int quality);

}  // namespace mfar
