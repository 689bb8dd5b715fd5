#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace mfar {

/// Behaviour of a mailbox whose sender is faster than its receiver.
enum class HandOver {
    /// For live sources: a newer item replaces the stored item, which counts as a drop.
    NewestWins,
    /// The sender waits until the receiver has taken the item and has asked for the next
    /// one. So no item is lost, and a run can be repeated exactly. Sources at the pace "consumer"
    /// use this.
    Lossless,
};

/// Holds one item on its way from a sending to a receiving thread. If T has the member `void
/// supersede(T&& older)`, this function is called on a newer item that replaces an older one. So
/// the newer item can keep parts of the older one. Thread-safe.
template <class T>
class Mailbox {
public:
    enum class Put { Stored, Replaced, Closed };

    explicit Mailbox(HandOver handOver) : handOver_(handOver) {}

    /// Stores an item. With HandOver::Lossless, also waits until the receiver has taken the item
    /// and the receiver asks for the next one. Returns Closed if the mailbox is closed before or
    /// during this wait.
    Put put(T item) {
        std::unique_lock lock(mutex_);
        if (closed_) return Put::Closed;
        std::optional<T> older = std::exchange(slot_, std::nullopt);
        if constexpr (requires(T newer) { newer.supersede(std::move(*older)); }) {
            if (older) item.supersede(std::move(*older));
        }
        slot_ = std::move(item);
        if (older) ++dropped_;
        stored_.notify_one();
        if (handOver_ == HandOver::Lossless) {
            asked_.wait(lock, [&] { return closed_ || (asking_ && !slot_); });
            if (closed_) return Put::Closed;
        }
        return older ? Put::Replaced : Put::Stored;
    }

    /// Waits for an item and returns it. Returns nothing if the mailbox is closed. Also returns
    /// nothing if the sender has called finish() and no item is stored.
    [[nodiscard]] std::optional<T> take() {
        return take([&](std::unique_lock<std::mutex>& lock) {
            stored_.wait(lock, [&] { return closed_ || finished_ || slot_; });
        });
    }

    /// Like take(), but returns nothing after the timeout.
    [[nodiscard]] std::optional<T> takeWithin(std::chrono::milliseconds timeout) {
        return take([&](std::unique_lock<std::mutex>& lock) {
            stored_.wait_for(lock, timeout, [&] { return closed_ || finished_ || slot_; });
        });
    }

    [[nodiscard]] bool over() const {
        const std::lock_guard lock(mutex_);
        return closed_ || (finished_ && !slot_);
    }

    [[nodiscard]] std::optional<T> tryTake() {
        const std::lock_guard lock(mutex_);
        return std::exchange(slot_, std::nullopt);
    }

    /// Must be called when the sender will store no more items. After that, take() still returns a
    /// stored item, and then nothing.
    void finish() {
        {
            const std::lock_guard lock(mutex_);
            finished_ = true;
        }
        stored_.notify_all();
    }

    /// Closes the mailbox. Sender and receiver wake up at once, and a stored item is destroyed. A
    /// second call does nothing.
    void close() {
        std::optional<T> left;
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
            left = std::exchange(slot_, std::nullopt);
        }
        stored_.notify_all();
        asked_.notify_all();
    }

    [[nodiscard]] std::uint64_t dropped() const {
        const std::lock_guard lock(mutex_);
        return dropped_;
    }

private:
    template <class Wait>
    std::optional<T> take(Wait wait) {
        std::unique_lock lock(mutex_);
        asking_ = true;
        asked_.notify_one();
        wait(lock);
        asking_ = false;
        return std::exchange(slot_, std::nullopt);
    }

    const HandOver handOver_;
    mutable std::mutex mutex_;
    std::condition_variable stored_;
    std::condition_variable asked_;
    std::optional<T> slot_;
    bool asking_ = false;
    bool finished_ = false;
    bool closed_ = false;
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
