#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace mfar {

/// The newest value from one thread to another without locks and waiting: one slot is the writer's,
/// one the reader's, the third lies between. What is overtaken is reused, never freed. Several
/// threads may share an end if something else keeps them from using it at once.
template <class T>
class TripleBuffer {
public:
    /// Writer: what will be published; it holds an older value until it is overwritten.
    [[nodiscard]] T& back() { return slots_[back_]; }
    void publish() {
        back_ = static_cast<std::uint8_t>(
            between_.exchange(back_ | kFresh, std::memory_order_acq_rel) & ~kFresh);
    }

    /// Reader: takes what was published since the last call; false if nothing was.
    bool fetch() {
        if ((between_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
        front_ = static_cast<std::uint8_t>(between_.exchange(front_, std::memory_order_acq_rel) &
                                           ~kFresh);
        return true;
    }
    /// Reader: the newest value fetched, in the same place until the next one is.
    [[nodiscard]] T& front() { return slots_[front_]; }
    [[nodiscard]] const T& front() const { return slots_[front_]; }

private:
    static constexpr std::uint8_t kFresh = 4;  // beside the number of a slot

    std::array<T, 3> slots_{};
    std::uint8_t back_ = 0, front_ = 1;
    std::atomic<std::uint8_t> between_{2};
};

}  // namespace mfar
