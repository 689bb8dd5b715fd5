#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace mfar {

/// Passes the newest value from one thread to another, without locks and without waiting. One of
/// three values belongs to the writer and one to the reader; the third is exchanged. Values that
/// were never read are overwritten, and their memory is reused. If several threads write or read,
/// the caller must ensure that only one does so at a time.
template <class T>
class TripleBuffer {
public:
    /// For the writer: the value to publish next. Until the writer changes it, it is an older value
    /// or T{}.
    [[nodiscard]] T& back() { return slots_[back_]; }
    void publish() {
        back_ = static_cast<std::uint8_t>(
            between_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh);
    }

    /// For the reader: fetches the newest published value. Returns false if nothing was published
    /// since the last call.
    bool fetch() {
        if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
        front_ = static_cast<std::uint8_t>(between_.exchange(front_, std::memory_order_acq_rel) &
                                           ~kFresh);
        return true;
    }
    /// For the reader: the last fetched value. Its address stays the same until the next fetch().
    [[nodiscard]] T& front() { return slots_[front_]; }
    [[nodiscard]] const T& front() const { return slots_[front_]; }

private:
    static constexpr std::uint8_t kFresh = 4;  // flag in between_: the value is new

    std::array<T, 3> slots_{};
    std::uint8_t back_ = 0, front_ = 1;
    std::atomic<std::uint8_t> between_{2};
};

}  // namespace mfar
