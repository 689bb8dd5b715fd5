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

/// A picture in a buffer of a camera. The destructor returns the buffer to the camera. Only one
/// thread at a time may use a frame.
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
    /// Returns the middle of the exposure on CLOCK_MONOTONIC. In a recording, it is the recorded
    /// time.
    [[nodiscard]] Timestamp time() const { return time_; }

    void shift(std::chrono::nanoseconds by) { time_ = time_ + by; }

    std::chrono::nanoseconds exposure{0};  ///< 0: unknown

private:
    ImageView view_;
    Timestamp time_;
    std::function<void()> giveBack_;
};

/// A fixed number of frame buffers of equal size, allocated once. Thread-safe. The pool may be
/// destroyed before its frames. Rows have no padding, and planes follow each other (packedView() in
/// image_layout.h).
class FramePool {
public:
    FramePool(Size size, PixelFormat format, int count);

    /// A buffer that the caller fills. It must then be passed to lend() or giveBack().
    struct Slot {
        std::uint8_t* data;
        std::size_t stride;
        int index;
    };
    /// Waits up to `timeout` for a free buffer. Returns nothing if no buffer became free.
    [[nodiscard]] std::optional<Slot> acquire(std::chrono::milliseconds timeout);
    [[nodiscard]] Frame lend(const Slot& slot, Timestamp time) const;
    /// `view` must lie in the buffer.
    [[nodiscard]] Frame lend(const Slot& slot, const ImageView& view, Timestamp time) const;
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
