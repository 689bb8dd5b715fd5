#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace mfar {

inline constexpr int kMaxPictureSide = 16384;  ///< [px]; a larger picture is taken for a fault

/// What a technician calls it: "NV12".
[[nodiscard]] std::string_view nameOf(PixelFormat format);

[[nodiscard]] int planeCount(PixelFormat format);

/// The pixels of one plane, without padding. Plane 0 is ImageView::data, plane 1 chroma[0].
struct PlaneSize {
    std::size_t rowBytes = 0;
    int rows = 0;
};
/// Nothing beyond planeCount(): 0 x 0.
[[nodiscard]] PlaneSize planeSize(PixelFormat format, Size size, int plane);

/// Of all planes, one after the other, rows without padding.
[[nodiscard]] std::size_t packedBytes(PixelFormat format, Size size);
/// A view of packedBytes() bytes in that order.
[[nodiscard]] ImageView packedView(const std::uint8_t* data, Size size, PixelFormat format);
/// Copies a sound picture into packedBytes() bytes and returns their view; matrix and range stay.
[[nodiscard]] ImageView packInto(std::uint8_t* data, const ImageView& picture);

/// Throws std::invalid_argument "WHAT: why" unless the view can be read as its format says: all
/// planes there, a size from 1 to kMaxPictureSide that is even where chroma is shared, strides that
/// hold a row.
void requireSound(const ImageView& picture, std::string_view what);

/// The luma of a sound picture that has it in a plane of its own, as Gray8, without a copy; nothing
/// for the packed formats. Its range stays: limited luma is full luma at a gain of 219/255 and 16
/// up, to which census, patch cost and tag detection are blind (order and normalised contrast).
[[nodiscard]] std::optional<ImageView> lumaPlane(const ImageView& picture);

/// What makes R G B of Y U V, all in [0, 255]: channel = row[0..2] . (Y, U, V) + row[3], to be
/// clamped. Rows in the order R, G, B. Source: ITU-R BT.601-7, BT.709-6, and JFIF for full range.
using YuvToRgb = std::array<std::array<float, 4>, 3>;
[[nodiscard]] YuvToRgb yuvToRgb(YuvMatrix matrix, YuvRange range);

}  // namespace mfar
