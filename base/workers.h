#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace mfar {

/// A few threads that execute a loop together with the caller, one loop at a time. The threads are
/// created once and wait between loops.
class Workers {
public:
    /// `threads`: number of threads, including the caller; 0: one per CPU, at most four.
    explicit Workers(int threads = 0);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    [[nodiscard]] int count() const { return static_cast<int>(threads_.size()) + 1; }

    /// Calls body(first, last) for consecutive parts of [0, end) and returns when all parts are
    /// done. Each part except the last has at least `grain` elements. Only one thread at a time may
    /// call this; body must not throw.
    void forRange(int end, int grain, const std::function<void(int, int)>& body);

private:
    void work(const std::stop_token& stop);
    bool takePart(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable_any begun_;
    std::condition_variable done_;
    const std::function<void(int, int)>* body_ = nullptr;
    int next_ = 0, end_ = 0, step_ = 1, running_ = 0;
    std::vector<std::jthread> threads_;  // must be the last member: threads use the members above
};

/// Does the same as workers->forRange(), without allocating memory. If `workers` is null, the
/// caller executes the whole loop.
template <class Body>
void forRange(Workers* workers, int end, int grain, const Body& body) {
    if (workers != nullptr)
        workers->forRange(end, grain, std::ref(body));
    else if (end > 0)
        body(0, end);
}

/// Calls body(row) once for each row in [first, last), like forRange().
template <class Body>
void forRows(Workers* workers, int first, int last, int grain, const Body& body) {
    forRange(workers, last - first, grain, [first, &body](int begin, int end) {
        for (int row = first + begin; row < first + end; ++row)
            body(row);
    });
}

}  // namespace mfar
