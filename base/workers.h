#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace mfar {

/// A few threads that execute one loop at a time together with the caller. Created once, idle
/// between loops.
class Workers {
public:
    /// `threads`: number including the caller; 0 = one per processor, at most four.
    explicit Workers(int threads = 0);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

    /// Calls body(first, last) on consecutive parts of [0, end), each but the last at least `grain`
    /// long, and returns when all are done. One caller at a time; body must not throw.
    void forRange(int end, int grain, const std::function<void(int, int)>& body);

private:
    void work(const std::stop_token& stop);
    bool takePart(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable_any begun_;
    std::condition_variable done_;
    const std::function<void(int, int)>* body_ = nullptr;
    int next_ = 0, end_ = 0, step_ = 1, running_ = 0;
    std::vector<std::jthread> threads_;  // last member: the threads use the members above
};

}  // namespace mfar
