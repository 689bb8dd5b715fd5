#pragma once

#include <atomic>
#include <deque>
#include <utility>

namespace mfar::simd {

/// Temporary memory for a loop that several threads execute. There is one object of type T for each
/// thread that can work at the same time. All objects are allocated once.
template <class T>
class ScratchSlots {
public:
    template <class Make>
    ScratchSlots(int threads, const Make& make) {
        for (int i = 0; i < threads; ++i)
            slots_.emplace_back(make());
    }

    template <class Body>
    void forEach(const Body& body) {
        for (Slot& slot : slots_)
            body(slot.scratch);
    }
    /// Calls `body` with an object that no other thread uses during the call.
    template <class Body>
    void with(const Body& body) {
        for (;;) {
            for (Slot& slot : slots_) {
                if (slot.taken.test_and_set(std::memory_order_acquire)) continue;
                body(slot.scratch);
                slot.taken.clear(std::memory_order_release);
                return;
            }
        }
    }

private:
    struct Slot {
        explicit Slot(T made) : scratch(std::move(made)) {}
        T scratch;
        std::atomic_flag taken;
    };
    std::deque<Slot> slots_;
};

}  // namespace mfar::simd
