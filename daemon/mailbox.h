#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace mfar {

/// What a mailbox does if the sender is faster than the receiver.
enum class HandOver {
    NewestWins,  ///< the waiting item is replaced and counted as dropped (live sources)
    /// The sender waits until the receiver has taken the item and asks for the next one. So no item
    /// is lost. Sender and receiver work alternately, so that a run can be repeated exactly
    /// (recordings at the pace "consumer").
    Lossless,
};

/// A slot for one item between a sending and a receiving thread. If an item is replaced and T has
/// the member `void supersede(T&& older)`, it is called on the newer item, which may keep parts of
/// the older one. Thread-safe.
template <class T>
class Mailbox {
public:
    enum class Put { Stored, Replaced, Closed };

    explicit Mailbox(HandOver handOver) : handOver_(handOver) {}

    /// Puts an item into the slot. Returns Closed if the mailbox is closed; the item is destroyed
    /// then, unless it was taken before.
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

    /// Waits for an item and returns it. Returns nothing if the mailbox is over().
    [[nodiscard]] std::optional<T> take() {
        return take([&](std::unique_lock<std::mutex>& lock) {
            stored_.wait(lock, [&] { return closed_ || finished_ || slot_; });
        });
    }

    /// Waits for an item, at most `timeout`, and returns it. Returns nothing after the timeout or
    /// if the mailbox is over().
    [[nodiscard]] std::optional<T> takeWithin(std::chrono::milliseconds timeout) {
        return take([&](std::unique_lock<std::mutex>& lock) {
            stored_.wait_for(lock, timeout, [&] { return closed_ || finished_ || slot_; });
        });
    }

    /// Returns whether no further item will come: the mailbox is closed, or finished and empty.
    [[nodiscard]] bool over() const {
        const std::lock_guard lock(mutex_);
        return closed_ || (finished_ && !slot_);
    }

    /// Returns the item if there is one. Never waits.
    [[nodiscard]] std::optional<T> tryTake() {
        const std::lock_guard lock(mutex_);
        return std::exchange(slot_, std::nullopt);
    }

    /// Announces that the sender will put no further item. take() returns the item that is still in
    /// the slot, and after that nothing.
    void finish() {
        {
            const std::lock_guard lock(mutex_);
            finished_ = true;
        }
        stored_.notify_all();
    }

    /// Closes the mailbox. Sender and receiver wake up at once, and an item in the slot is
    /// destroyed. Idempotent.
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

    /// Returns the number of items that were replaced before they were taken.
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
    bool asking_ = false;  ///< whether the receiver waits in take()
    bool finished_ = false;
    bool closed_ = false;
    std::uint64_t dropped_ = 0;
};

}  // namespace mfar
