#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar {

inline constexpr int kMaxPictureSide = 16384;  ///< [px]; a larger picture counts as a fault

/// The format's usual name: "NV12".
[[nodiscard]] std::string_view nameOf(PixelFormat format);

[[nodiscard]] int planeCount(PixelFormat format);

/// Size of one plane in pixels, without padding. Plane 0 is ImageView::data, plane 1 chroma[0].
struct PlaneSize {
    std::size_t rowBytes = 0;
    int rows = 0;
};
/// 0 x 0 from planeCount() on.
[[nodiscard]] PlaneSize planeSize(PixelFormat format, Size size, int plane);

/// Size of all planes, one after the other, rows without padding.
[[nodiscard]] std::size_t packedBytes(PixelFormat format, Size size);
/// A view of packedBytes() bytes in the order of packedBytes().
[[nodiscard]] ImageView packedView(const std::uint8_t* data, Size size, PixelFormat format);
/// Copies a valid picture into packedBytes() bytes and returns their view; matrix and range stay.
[[nodiscard]] ImageView packInto(std::uint8_t* data, const ImageView& picture);

/// Throws std::invalid_argument "WHAT: reason" unless the view can be read as its format requires:
/// all planes exist, sides from 1 to kMaxPictureSide, even where chroma is shared, and strides that
/// hold a row.
void requireSound(const ImageView& picture, std::string_view what);

/// The luma of a valid picture that has it in a plane of its own, as Gray8, without a copy; empty
/// for packed formats. The range is not converted: limited luma is full luma times 219/255 plus 16,
/// which does not affect census, patch cost and tag detection (they use order and normalised
/// contrast).
[[nodiscard]] std::optional<ImageView> lumaPlane(const ImageView& picture);

/// Conversion from Y U V to R G B, all in [0, 255]: channel = row[0..2] . (Y, U, V) + row[3], to be
/// clamped. Rows in the order R, G, B. Source: ITU-R BT.601-7, BT.709-6, and JFIF for full range.
using YuvToRgb = std::array<std::array<float, 4>, 3>;
[[nodiscard]] YuvToRgb yuvToRgb(YuvMatrix matrix, YuvRange range);

}  // namespace mfar
