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

/// Calls that one thread asks another thread, the Target's, to execute. All functions may be called
/// from any thread.
template <class Target>
class CallQueue {
public:
    /// `wake` notifies the other thread of a new call; empty: that thread polls.
    explicit CallQueue(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

    /// The result or exception of `work`, executed by the other thread. Throws std::runtime_error
    /// after `limit` (the call may still be executed later) or when it will never be executed.
    template <class Work>
    std::invoke_result_t<Work, Target&> call(Work work, std::chrono::milliseconds limit) {
        using Result = std::invoke_result_t<Work, Target&>;
        auto task = std::make_shared<std::packaged_task<Result(Target&)>>(std::move(work));
        std::future<Result> result = task->get_future();
        // The queue holds the only reference: when it drops the call, the promise breaks and the
        // caller wakes.
        put([task = std::move(task)](Target& target) { (*task)(target); });
        if (result.wait_for(limit) != std::future_status::ready)
            throw std::runtime_error("mfard is too busy to answer");
        return result.get();
    }

    /// Executes the queued calls.
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

    /// Refuses all further calls.
    void close() {
        std::deque<std::function<void(Target&)>> left;
        const std::lock_guard lock(mutex_);
        closed_ = true;
        left.swap(waiting_);
    }

private:
    void put(std::function<void(Target&)> work) {
        {
            const std::lock_guard lock(mutex_);
            if (closed_) throw std::runtime_error("mfard is ending");
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
