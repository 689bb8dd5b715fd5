#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar {

struct Size {
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
    bool operator==(const Size&) const = default;
};

/// Layout of the pixels in memory. Rows may be padded, see ImageView::stride.
enum class PixelFormat : std::uint8_t {
    Gray8,   ///< one byte of luma
    Rgba8,   ///< four bytes R G B A, alpha ignored
    Bgra8,   ///< four bytes B G R A, alpha ignored (DRM's XRGB8888)
    Yuyv,    ///< 4:2:2, four bytes Y0 U Y1 V for two pixels; even width
    Nv12,    ///< 4:2:0, a plane of Y, a plane of U V pairs; even width and height
    Yuv420,  ///< 4:2:0, planes of Y, of U and of V; even width and height
};

/// Size of a pixel in the first (or only) plane [bytes].
[[nodiscard]] constexpr int bytesPerPixel(PixelFormat format) {
    switch (format) {
    case PixelFormat::Rgba8:
    case PixelFormat::Bgra8: return 4;
    case PixelFormat::Yuyv: return 2;
    case PixelFormat::Gray8:
    case PixelFormat::Nv12:
    case PixelFormat::Yuv420: break;
    }
    return 1;
}

/// Conversion from Y U V to R G B: ITU-R BT.601 or BT.709.
enum class YuvMatrix : std::uint8_t { Bt601, Bt709 };
/// Y in 16..235 and U, V in 16..240 (limited), or all three in 0..255 (full, as in JPEG).
enum class YuvRange : std::uint8_t { Limited, Full };

/// A further plane of a planar picture.
struct PlaneView {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;  ///< bytes from one row to the next
};

/// Where the planes of a picture lie in memory that other devices can read as well (dma-buf).
struct SharedMemory {
    std::uint64_t id = 0;  ///< identifies this memory; never reused
    struct Plane {
        int fd = -1;
        std::size_t offset = 0;  ///< bytes from the start of the buffer
    };
    std::array<Plane, 3> planes{};
};
/// An id that is new in this process. Callable from any thread.
[[nodiscard]] std::uint64_t newSharedMemoryId();

/// Borrowed, read-only pixels. Origin top left, row 0 first. Never owns.
struct ImageView {
    const std::uint8_t* data = nullptr;
    Size size;
    std::size_t stride = 0;  ///< bytes from one row to the next
    PixelFormat format = PixelFormat::Rgba8;
    std::array<PlaneView, 2> chroma{};  ///< Nv12: U V in [0]; Yuv420: U in [0], V in [1]
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
    const SharedMemory* shared = nullptr;  ///< where the same planes are shared; null: not shared
};

}  // namespace mfar
