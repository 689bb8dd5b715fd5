#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace mfar {

/// A queue of function calls. Other threads request the calls, and the thread of a Target object
/// executes them. Thread-safe.
template <class Target>
class CallQueue {
public:
    /// `wake` tells the Target's thread that a call is waiting. If `wake` is empty, that thread
    /// must call runAll() regularly.
    explicit CallQueue(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

    /// Waits until the Target's thread has called `work`. Returns the result of `work` or throws
    /// its exception. Throws std::runtime_error if the queue is closed before the call, or
    /// if the wait is longer than `limit`; in the second case, `work` may still be called later.
    template <class Work>
    std::invoke_result_t<Work, Target&> call(Work work, std::chrono::milliseconds limit) {
        using Result = std::invoke_result_t<Work, Target&>;
        auto task = std::make_shared<std::packaged_task<Result(Target&)>>(std::move(work));
        std::future<Result> result = task->get_future();
        // The queue holds the only reference to the task. If the queue discards the task, the
        // promise is broken, and the caller's wait ends.
        put([task = std::move(task)](Target& target) { (*task)(target); });
        if (result.wait_for(limit) != std::future_status::ready)
            throw std::runtime_error("mfard is too busy to answer; try again later");
        try {
            return result.get();
        } catch (const std::future_error&) {
            throw std::runtime_error(kClosed);
        }
    }

    /// Must be called by the Target's thread.
    void runAll(Target& target) {
        for (;;) {
            std::function<void(Target&)> next;
            {
                const std::lock_guard lock(mutex_);
                if (waiting_.empty()) return;
                next = std::move(waiting_.front());
                waiting_.pop_front();
            }
            next(target);
        }
    }

    void close() {
        std::deque<std::function<void(Target&)>> left;
        const std::lock_guard lock(mutex_);
        closed_ = true;
        left.swap(waiting_);
    }

private:
    static constexpr const char* kClosed = "mfard is ending";

    void put(std::function<void(Target&)> work) {
        {
            const std::lock_guard lock(mutex_);
            if (closed_) throw std::runtime_error(kClosed);
            waiting_.push_back(std::move(work));
        }
        if (wake_) wake_();
    }

    const std::function<void()> wake_;
    std::mutex mutex_;
    std::deque<std::function<void(Target&)>> waiting_;
    bool closed_ = false;
};

}  // namespace mfar
