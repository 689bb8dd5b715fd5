#pragma once

#include "base/image_view.h"
#include "base/time.h"
#include "base/zeroed_array.h"

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

/// A picture lent by a camera: move-only, returns its buffer when destroyed. May be moved from the
/// capture thread to another; at most one thread uses it at a time.
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

    /// Converts the time to another clock.
    void shift(std::chrono::nanoseconds by) { time_ = time_ + by; }

    std::chrono::nanoseconds exposure{0};  ///< 0 = unknown

private:
    ImageView view_;
    Timestamp time_;
    std::function<void()> giveBack_;
};

/// A fixed set of equal buffers, allocated once and lent as Frames; a buffer that is never lent
/// takes no memory. Thread-safe. The pool may be destroyed before its frames: the memory lives
/// until the last frame is returned. Planes follow each other and rows have no padding
/// (packedView() in image_layout.h).
class FramePool {
public:
    FramePool(Size size, PixelFormat format, int count);

    /// A buffer to be filled and then lent; empty when all are lent after `timeout`.
    struct Slot {
        std::uint8_t* data;
        std::size_t stride;
        int index;
    };
    [[nodiscard]] std::optional<Slot> acquire(std::chrono::milliseconds timeout);
    /// Turns a filled slot into a frame whose destruction returns the buffer.
    [[nodiscard]] Frame lend(const Slot& slot, Timestamp time) const;
    /// As above, with another view of the slot's memory, in which it must fit.
    [[nodiscard]] Frame lend(const Slot& slot, const ImageView& view, Timestamp time) const;
    /// Returns a slot that was acquired but will not be lent.
    void giveBack(const Slot& slot) const;

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] PixelFormat format() const { return format_; }

private:
    struct Shared {
        std::mutex mutex;
        std::condition_variable returned;
        std::vector<ZeroedArray<std::uint8_t>> buffers;
        std::vector<int> free;
    };
    Size size_;
    PixelFormat format_;
    std::shared_ptr<Shared> shared_;
};

}  // namespace mfar
