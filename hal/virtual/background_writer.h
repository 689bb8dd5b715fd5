#pragma once

#include "base/heartbeats.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mfar {

/// Threads that write files for a caller that must not wait for the disk. Jobs start in the order
/// in which they were posted. The queue is not limited by itself: the buffers that jobs hold limit
/// it. After the first job that throws, all others are dropped: a full disk gives one error, not
/// thousands.
class BackgroundWriter {
public:
    /// Heartbeats of each thread use `watched`, whose budget is for one job.
    explicit BackgroundWriter(int threads, const WatchedThread& watched = {});
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;
    /// Waits for the posted jobs; ignores their errors, see drain().
    ~BackgroundWriter();

    /// Thread-safe, never waits for a job.
    void post(std::function<void()> job);
    /// Waits until every posted job is done. Throws std::runtime_error with the first failure.
    void drain();
    /// As drain(), for at most `limit`; false at the limit.
    [[nodiscard]] bool drainWithin(std::chrono::milliseconds limit);
    /// The first failure, without waiting. Thread-safe.
    [[nodiscard]] std::optional<std::string> error() const;

private:
    void work(const WatchedThread& watched);

    mutable std::mutex mutex_;
    std::condition_variable posted_;
    std::condition_variable idle_;
    std::deque<std::function<void()>> jobs_;
    int running_ = 0;
    bool closing_ = false;
    std::optional<std::string> error_;
    std::vector<std::thread> threads_;
};

}  // namespace mfar
