#pragma once

#include "hal/time.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

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

/// Of the first (or only) plane.
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

/// How Y U V become R G B. ITU-R BT.601 or BT.709.
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
    std::uint64_t id = 0;  ///< of this memory, never another's
    struct Plane {
        int fd = -1;
        std::size_t offset = 0;  ///< bytes from the begin of the buffer
    };
    std::array<Plane, 3> planes{};
};
/// One that nobody has had in this process. Any thread.
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
    const SharedMemory* shared = nullptr;  ///< where the same planes are; none: here alone
};

/// A picture on loan from a camera: move-only, gives its buffer back when destroyed. May be handed
/// from the capture thread to another; at most one thread touches it at a time.
class Frame {
public:
    Frame(ImageView view, Timestamp time, std::function<void()> giveBack)
        : view_(view), time_(time), giveBack_(std::move(giveBack)) {}
    Frame(Frame&& other) noexcept
        : exposure(other.exposure), view_(other.view_), time_(other.time_),
          giveBack_(std::exchange(other.giveBack_, nullptr)) {}
    Frame& operator=(Frame&& other) noexcept {
        Frame taken(std::move(other));
        std::swap(exposure, taken.exposure);
        std::swap(view_, taken.view_);
        std::swap(time_, taken.time_);
        std::swap(giveBack_, taken.giveBack_);
        return *this;
    }
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;
    ~Frame() {
        if (giveBack_) giveBack_();
    }

    [[nodiscard]] const ImageView& view() const { return view_; }
    /// Middle of the exposure, CLOCK_MONOTONIC (recordings: the file's own epoch).
    [[nodiscard]] Timestamp time() const { return time_; }

    /// To another clock.
    void shift(std::chrono::nanoseconds by) { time_ = time_ + by; }

    std::chrono::nanoseconds exposure{0};  ///< 0 = unknown

private:
    ImageView view_;
    Timestamp time_;
    std::function<void()> giveBack_;
};

/// A fixed set of equal buffers, allocated once, lent out as Frames. Thread-safe. The pool may be
/// destroyed before its frames: the memory lives until the last loan is back. Planes follow each
/// other and rows have no padding (packedView() in image_layout.h).
class FramePool {
public:
    FramePool(Size size, PixelFormat format, int count);

    /// A buffer to fill and then send; nothing when all are out after `timeout`.
    struct Slot {
        std::uint8_t* data;
        std::size_t stride;
        int index;
    };
    [[nodiscard]] std::optional<Slot> acquire(std::chrono::milliseconds timeout);
    /// Turns a filled slot into a frame whose destruction returns the buffer.
    [[nodiscard]] Frame lend(const Slot& slot, Timestamp time) const;
    /// The same, seen in another way that fits into the slot's memory.
    [[nodiscard]] Frame lend(const Slot& slot, const ImageView& view, Timestamp time) const;
    /// Returns a slot that was acquired but will not be lent.
    void giveBack(const Slot& slot) const;

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] PixelFormat format() const { return format_; }

private:
    struct Shared {
        std::mutex mutex;
        std::condition_variable returned;
        std::vector<std::vector<std::uint8_t>> buffers;
        std::vector<int> free;
    };
    Size size_;
    PixelFormat format_;
    std::shared_ptr<Shared> shared_;
};

}  // namespace mfar
