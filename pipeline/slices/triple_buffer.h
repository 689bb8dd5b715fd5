#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace mfar {

/// Passes the newest value from one thread to another without locks or waiting: one slot belongs to
/// the writer, one to the reader, the third lies between. Overtaken values are reused, never freed.
/// Several threads may share an end if something else keeps them from using it at once.
template <class T>
class TripleBuffer {
public:
    /// Writer: the slot that will be published next; it holds an older value until overwritten.
    [[nodiscard]] T& back() { return slots_[back_]; }
    void publish() {
        back_ = static_cast<std::uint8_t>(
            between_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh);
    }

    /// Reader: takes the newest published value; false if nothing was published since the last
    /// call.
    bool fetch() {
        if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
        front_ = static_cast<std::uint8_t>(between_.exchange(front_, std::memory_order_acq_rel) &
                                           ~kFresh);
        return true;
    }
    /// Reader: the last value fetched; its address stays the same until the next fetch().
    [[nodiscard]] T& front() { return slots_[front_]; }
    [[nodiscard]] const T& front() const { return slots_[front_]; }

private:
    static constexpr std::uint8_t kFresh = 4;  // flag next to the slot's number

    std::array<T, 3> slots_{};
    std::uint8_t back_ = 0, front_ = 1;
    std::atomic<std::uint8_t> between_{2};
};

}  // namespace mfar
