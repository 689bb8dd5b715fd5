#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mfar {

struct Size {
    /// Width and height in pixels.
    int width = 0;
    int height = 0;
    bool operator==(const Size&) const = default;
};

/// Layout of pixels in memory. Rows may be padded, see ImageView::stride.
enum class PixelFormat : std::uint8_t {
    Gray8,
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

/// The standard that defines the conversion from Y U V to R G B: ITU-R BT.601 or BT.709.
enum class YuvMatrix : std::uint8_t { Bt601, Bt709 };
/// Limited: Y is in 16..235, U and V in 16..240. Full, as in JPEG: all three are in 0..255.
enum class YuvRange : std::uint8_t { Limited, Full };

struct PlaneView {
    const std::uint8_t* data = nullptr;
    std::size_t stride = 0;  ///< bytes from one row to the next
};

/// The dma-bufs that hold a picture's planes. Other devices, e.g. the GPU, can read them.
struct SharedMemory {
    std::uint64_t id = 0;  ///< from newSharedMemoryId(); differs for each memory of this process
    struct Plane {
        int fd = -1;
        std::size_t offset = 0;
    };
    std::array<Plane, 3> planes{};
};
[[nodiscard]] std::uint64_t newSharedMemoryId();

/// A read-only view of a picture; it does not own the pixels. The origin is top left, row 0 is
/// first.
struct ImageView {
    const std::uint8_t* data = nullptr;
    Size size;
    std::size_t stride = 0;  ///< bytes from one row to the next
    PixelFormat format = PixelFormat::Rgba8;
    std::array<PlaneView, 2> chroma{};  ///< Nv12: U V in [0]; Yuv420: U in [0], V in [1]
    YuvMatrix matrix = YuvMatrix::Bt601;
    YuvRange range = YuvRange::Limited;
    const SharedMemory* shared = nullptr;  ///< the same planes as dma-bufs; null: there are none
};

}  // namespace mfar
