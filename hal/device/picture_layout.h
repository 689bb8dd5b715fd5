#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar {

/// What a driver says about its pictures.
struct PictureLayout {
    Size size;
    PixelFormat format = PixelFormat::Nv12;
    std::size_t stride = 0;  ///< bytes, of the first plane
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
};

struct PlaneBytes {
    const std::uint8_t* data = nullptr;
    std::size_t length = 0;
};

/// The bytes that a picture needs at least: its last row need not be padded.
[[nodiscard]] std::size_t leastBytes(const PictureLayout& layout);

/// The picture in a driver's buffer: one plane of memory for each of the format, or one for all,
/// which then follow each other. Chroma rows have the stride of luma (Nv12) or half of it (Yuv420).
/// Throws std::runtime_error when a plane is missing or too short, or the stride is below a row.
[[nodiscard]] ImageView layOut(const PictureLayout& layout, std::span<const PlaneBytes> planes);

}  // namespace mfar
