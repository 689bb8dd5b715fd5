#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace mfar {

/// Ends a shutdown that hangs: a thread of its own calls `act` after a time limit, unless this
/// object has been destroyed by then. Used by one thread.
class LastResort {
public:
    /// `act` is called on that thread. A second call is ignored.
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
