#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar {

/// A driver's description of its pictures.
struct PictureLayout {
    Size size;
    PixelFormat format = PixelFormat::Nv12;
    std::size_t stride = 0;  ///< bytes, first plane
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
};

struct PlaneBytes {
    const std::uint8_t* data = nullptr;
    std::size_t length = 0;
};

/// Minimum number of bytes of a picture: its last row need not be padded.
[[nodiscard]] std::size_t leastBytes(const PictureLayout& layout);

/// The picture in a driver's buffer: one memory plane for each plane of the format, or one for all
/// planes, one after the other. Chroma rows have the stride of luma (Nv12) or half of it (Yuv420).
/// Throws std::runtime_error when a plane is missing or too short, or the stride is shorter than a
/// row.
[[nodiscard]] ImageView layOut(const PictureLayout& layout, std::span<const PlaneBytes> planes);

}  // namespace mfar
