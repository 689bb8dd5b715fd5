#pragma once

#include "hal/time.h"

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

/// Layout of one pixel in memory. Rows may be padded, see ImageView::stride.
enum class PixelFormat : std::uint8_t {
    Gray8,  ///< one byte of luma
    Rgba8,  ///< four bytes R G B A, alpha ignored
};

[[nodiscard]] constexpr int bytesPerPixel(PixelFormat format) {
    return format == PixelFormat::Gray8 ? 1 : 4;
}

/// Borrowed, read-only pixels. Origin top left, row 0 first. Never owns.
struct ImageView {
    const std::uint8_t* data = nullptr;
    Size size;
    std::size_t stride = 0;  ///< bytes from one row to the next
    PixelFormat format = PixelFormat::Rgba8;
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

    std::chrono::nanoseconds exposure{0};  ///< 0 = unknown

private:
    ImageView view_;
    Timestamp time_;
    std::function<void()> giveBack_;
};

/// A fixed set of equal buffers, allocated once, lent out as Frames. Thread-safe. The pool may be
/// destroyed before its frames: the memory lives until the last loan is back.
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
