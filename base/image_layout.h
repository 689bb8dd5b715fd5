#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar {

inline constexpr int kMaxPictureSide = 16384;

[[nodiscard]] std::string_view nameOf(PixelFormat format);

[[nodiscard]] int planeCount(PixelFormat format);

/// Size of one plane without padding. Plane 0 is ImageView::data, plane 1 is ImageView::chroma[0].
struct PlaneSize {
    std::size_t rowBytes = 0;
    int rows = 0;
};
/// Returns the size of a plane; 0 x 0 if the format does not have the plane.
[[nodiscard]] PlaneSize planeSize(PixelFormat format, Size size, int plane);

/// Returns the size [bytes] of a packed picture, whose planes follow each other without padding.
[[nodiscard]] std::size_t packedBytes(PixelFormat format, Size size);
[[nodiscard]] ImageView packedView(const std::uint8_t* data, Size size, PixelFormat format);
/// Copies a valid picture into packedBytes() bytes at `data` and returns a view of the copy, with
/// the same YUV matrix and range.
[[nodiscard]] ImageView packInto(std::uint8_t* data, const ImageView& picture);

/// Throws std::invalid_argument "WHAT: reason" if a plane is missing, if a side is not from 1 to
/// kMaxPictureSide, if a side is odd although the format subsamples chroma along it, or if a stride
/// is smaller than a row.
void requireSound(const ImageView& picture, std::string_view what);

/// Returns a Gray8 view of a valid picture's luma plane, without a copy. Returns nothing if the
/// format has no separate luma plane. The values are not converted to another YuvRange, because the
/// steps that use this view work with both ranges.
[[nodiscard]] std::optional<ImageView> lumaPlane(const ImageView& picture);

/// Conversion from Y U V to R G B, all in [0, 255]: channel = row[0..2] . (Y, U, V) + row[3]. The
/// result must be clamped. The rows are in the order R, G, B. Source: ITU-R BT.601-7, BT.709-6, and
/// JFIF for full range.
using YuvToRgb = std::array<std::array<float, 4>, 3>;
[[nodiscard]] YuvToRgb yuvToRgb(YuvMatrix matrix, YuvRange range);

}  // namespace mfar
