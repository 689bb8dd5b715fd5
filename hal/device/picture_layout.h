#pragma once

#include "base/image_view.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mfar {

struct PictureLayout {
    Size size;
    PixelFormat format = PixelFormat::Nv12;
    std::size_t stride = 0;
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
};

struct PlaneBytes {
    const std::uint8_t* data = nullptr;
    std::size_t length = 0;
};

[[nodiscard]] std::size_t leastBytes(const PictureLayout& layout);

/// Returns a view of the picture in a driver's buffer. `planes` has one element per plane of the
/// format, or one element that holds all planes one after the other. The stride of chroma rows is
/// that of luma rows (Nv12) or half of it (Yuv420). Throws std::runtime_error if a plane is missing
/// or too short, or if the stride is shorter than a row.
[[nodiscard]] ImageView layOut(const PictureLayout& layout, std::span<const PlaneBytes> planes);

}  // namespace mfar
