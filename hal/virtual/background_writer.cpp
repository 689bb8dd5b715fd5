#include "hal/virtual/background_writer.h"

#include <pthread.h>
#include <signal.h>

#include <exception>
#include <stdexcept>
#include <utility>

namespace mfar {

BackgroundWriter::BackgroundWriter(int threads, const WatchedThread& watched) {
    for (int i = 0; i < threads; ++i)
        threads_.emplace_back([this, watched] { work(watched); });
}

BackgroundWriter::~BackgroundWriter() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    posted_.notify_all();
    for (std::thread& t : threads_)
        t.join();
}

void BackgroundWriter::post(std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    posted_.notify_one();
}

void BackgroundWriter::drain() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return jobs_.empty() && running_ == 0; });
    if (error_) throw std::runtime_error(*error_);
}

bool BackgroundWriter::drainWithin(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    const bool done =
        idle_.wait_for(lock, limit, [this] { return jobs_.empty() && running_ == 0; });
    if (error_) throw std::runtime_error(*error_);
    return done;
}

std::optional<std::string> BackgroundWriter::error() const {
    const std::lock_guard lock(mutex_);
    return error_;
}

void BackgroundWriter::work(const WatchedThread& watched) {
    // SIGPIPE is blocked, so that write() to a pipe without a reader fails and does not end the
    // process.
    sigset_t brokenPipe;
    sigemptyset(&brokenPipe);
    sigaddset(&brokenPipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &brokenPipe, nullptr);

    Heartbeat heart(watched);
    std::unique_lock lock(mutex_);
    for (;;) {
        heart.rest();
        posted_.wait(lock, [this] { return closing_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        ++running_;
        const bool skip = error_.has_value();
        lock.unlock();
        heart.beat();
        std::optional<std::string> failure;
        try {
            if (!skip) job();
        } catch (const std::exception& e) {
            failure = e.what();
        }
        // The job's destructor gives back the job's buffer. This must happen before idle_ is
        // notified.
        job = nullptr;
        lock.lock();
        if (failure && !error_) error_ = std::move(failure);
        if (--running_ == 0 && jobs_.empty()) idle_.notify_all();
    }
}

}  // namespace mfar
