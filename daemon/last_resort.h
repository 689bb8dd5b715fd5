#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace mfar {

/// Calls a function after a time limit, on a thread of its own. If this object is destroyed before
/// the limit, the function is not called. Used to end a shutdown that hangs. Only one thread may
/// use it.
class LastResort {
public:
    /// Starts the time limit. A second call is ignored.
    void arm(std::chrono::milliseconds limit, std::function<void()> act) {
        if (thread_.joinable()) return;
        thread_ = std::jthread([limit, act = std::move(act)](const std::stop_token& stop) {
            std::mutex mutex;
            std::condition_variable_any ended;
            std::unique_lock lock(mutex);
            (void)ended.wait_for(lock, stop, limit, [] { return false; });
            if (!stop.stop_requested()) act();
        });
    }

private:
    std::jthread thread_;
};

}  // namespace mfar
