#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace mfar {

/// Passes the newest value from one thread to another without locks and without waiting. One slot
/// belongs to the writer, one to the reader, and the third is exchanged between them. Values that
/// were never read are overwritten; their memory is reused. There may be several writing or several
/// reading threads if other means ensure that only one of them writes and one reads at a time.
template <class T>
class TripleBuffer {
public:
    /// For the writer: the slot that publish() will publish next. It holds an older value until it
    /// is overwritten.
    [[nodiscard]] T& back() { return slots_[back_]; }
    void publish() {
        back_ = static_cast<std::uint8_t>(
            between_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh);
    }

    /// For the reader: takes the newest published value. Returns false if nothing was published
    /// since the last call.
    bool fetch() {
        if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
        front_ = static_cast<std::uint8_t>(between_.exchange(front_, std::memory_order_acq_rel) &
                                           ~kFresh);
        return true;
    }
    /// For the reader: the last value taken. Its address stays the same until the next fetch().
    [[nodiscard]] T& front() { return slots_[front_]; }
    [[nodiscard]] const T& front() const { return slots_[front_]; }

private:
    static constexpr std::uint8_t kFresh = 4;  // flag in between_: the slot's value was not fetched

    std::array<T, 3> slots_{};
    std::uint8_t back_ = 0, front_ = 1;
    std::atomic<std::uint8_t> between_{2};
};

}  // namespace mfar
