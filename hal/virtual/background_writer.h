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
/// in which they were posted. The length of the queue has no limit of its own: the number of
/// buffers that jobs hold limits it. After a job has thrown, all further jobs are discarded, so
/// that a full disk causes one error and not thousands.
class BackgroundWriter {
public:
    /// `watched`: how each thread is registered with Heartbeats. Its time budget is the longest
    /// time of one job.
    explicit BackgroundWriter(int threads, const WatchedThread& watched = {});
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;
    /// Waits for all posted jobs. Their errors are ignored; drain() reports errors.
    ~BackgroundWriter();

    /// Adds a job to the queue. Thread-safe; never waits for a job.
    void post(std::function<void()> job);
    /// Waits until every posted job is done. Throws std::runtime_error with the error of the first
    /// job that failed.
    void drain();
    /// Waits until every posted job is done, but at most `limit`. Returns false if jobs are left
    /// after that time. Throws like drain().
    [[nodiscard]] bool drainWithin(std::chrono::milliseconds limit);
    /// Returns the error of the first job that failed so far. Thread-safe; never waits.
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
