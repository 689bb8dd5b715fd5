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

/// Threads that write files for a caller who must not wait for the disk. Jobs start in the order
/// they were posted. The queue has no limit of its own: what a job carries (a buffer of a pool)
/// bounds it. After the first job that throws, the others are dropped unrun: a full disk gives one
/// error, not thousands.
class BackgroundWriter {
public:
    /// Each thread is watched as `watched`, whose budget is for one job.
    explicit BackgroundWriter(int threads, const WatchedThread& watched = {});
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;
    /// Waits for the posted jobs; their errors are lost, see drain().
    ~BackgroundWriter();

    /// Thread-safe, never waits for a job.
    void post(std::function<void()> job);
    /// Waits until every posted job is done. Throws std::runtime_error with the first failure.
    void drain();
    /// The same for at most `limit`; false when that was too short.
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
