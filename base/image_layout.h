#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar {

inline constexpr int kMaxPictureSide = 16384;  ///< [px]; larger pictures are refused

/// Returns the format's usual name, such as "NV12".
[[nodiscard]] std::string_view nameOf(PixelFormat format);

[[nodiscard]] int planeCount(PixelFormat format);

/// Size of one plane without padding. Plane 0 is ImageView::data, plane 1 is ImageView::chroma[0].
struct PlaneSize {
    std::size_t rowBytes = 0;
    int rows = 0;
};
/// Returns the size of a plane; 0 x 0 if the format does not have the plane.
[[nodiscard]] PlaneSize planeSize(PixelFormat format, Size size, int plane);

/// Returns the number of bytes of a packed picture: its planes follow each other, and its rows have
/// no padding.
[[nodiscard]] std::size_t packedBytes(PixelFormat format, Size size);
/// Returns a view of a packed picture, which has packedBytes() bytes at `data`.
[[nodiscard]] ImageView packedView(const std::uint8_t* data, Size size, PixelFormat format);
/// Copies a valid picture into packedBytes() bytes at `data` and returns a view of the copy, with
/// the same YUV matrix and range.
[[nodiscard]] ImageView packInto(std::uint8_t* data, const ImageView& picture);

/// Throws std::invalid_argument "WHAT: reason" if a plane is missing, if width or height is not
/// from 1 to kMaxPictureSide, if width or height is odd although the format subsamples chroma along
/// it, or if a stride is smaller than a row.
void requireSound(const ImageView& picture, std::string_view what);

/// Returns a Gray8 view of a valid picture's luma plane, without a copy, or nothing if the format
/// has no separate luma plane. The range is not converted: limited luma is full luma * 219/255
/// + 16. This does not affect census, patch cost and tag detection, because they use the order of
/// values or normalised contrast.
[[nodiscard]] std::optional<ImageView> lumaPlane(const ImageView& picture);

/// Conversion from Y U V to R G B, all in [0, 255]: channel = row[0..2] . (Y, U, V) + row[3]. The
/// result must be clamped. The rows are in the order R, G, B. Source: ITU-R BT.601-7, BT.709-6, and
/// JFIF for full range.
using YuvToRgb = std::array<std::array<float, 4>, 3>;
[[nodiscard]] YuvToRgb yuvToRgb(YuvMatrix matrix, YuvRange range);

}  // namespace mfar
