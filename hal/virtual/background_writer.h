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
/// in which they were posted. The queue itself has no limit. Callers limit it: each picture that
/// waits for its job holds one of a fixed number of buffers. After a job has thrown, further jobs
/// are discarded, so that a full disk causes one error and not thousands.
class BackgroundWriter {
public:
    /// Each thread is registered with `watched.all`. `watched.budget` is the longest allowed time
    /// of one job.
    explicit BackgroundWriter(int threads, const WatchedThread& watched = {});
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;
    ~BackgroundWriter();

    void post(std::function<void()> job);
    /// Waits until every posted job is done. Throws std::runtime_error with the error of the first
    /// job that failed.
    void drain();
    /// Waits like drain(), but at most `limit`. Returns false if some jobs are not done by then.
    [[nodiscard]] bool drainWithin(std::chrono::milliseconds limit);
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
