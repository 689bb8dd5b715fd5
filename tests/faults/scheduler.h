#pragma once

#include <poll.h>
#include <pthread.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace mfar::faults {

using Ns = std::int64_t;
constexpr Ns kNever = std::numeric_limits<Ns>::max();
constexpr Ns kMs = 1'000'000, kSecond = 1'000'000'000;

/// Runs the threads of this process one at a time, on a clock of its own: it passes a little with
/// each look at it, and jumps to the next deadline when every thread waits. So an hour of waiting
/// costs nothing, and as the next thread to run is drawn from a seed, a run can be repeated.
///
/// A thread gives its turn away where it waits (see calls.cpp), and now and then where it locks.
/// All functions belong to the thread whose turn it is, so nothing here is locked.
class Scheduler {
public:
    /// Made with the first call; never destroyed, as threads outlive main().
    static Scheduler& get();

    /// False in a thread that has given up its turn for ever, within the C library's last clean-up.
    [[nodiscard]] bool hasTurn() const;

    [[nodiscard]] Ns now() const { return now_; }
    /// The time, after what the look costs.
    [[nodiscard]] Ns look() { return now_ += cost_; }
    void setCost(Ns cost) { cost_ = cost; }
    /// Of CLOCK_REALTIME, before that of the other clocks.
    [[nodiscard]] Ns wallOffset() const { return wallOffset_; }
    void stepWall(Ns by) { wallOffset_ += by; }

    /// Waits until wake() with this key, false when the time is over.
    bool waitFor(const void* key, Ns deadline = kNever);
    /// The first of those that wait, at most `count`; returns how many.
    int wake(const void* key, int count = std::numeric_limits<int>::max());
    /// As poll(), -1 with errno included.
    int waitForFiles(pollfd* fds, nfds_t count, Ns deadline);
    /// Others may go first.
    void yield();
    /// The same now and then.
    void maybeYield();

    /// A timer's descriptor becomes readable at `first`, then every `period`; 0: never, once.
    void setTimer(int fd, Ns first, Ns period);
    void addTimer(int fd) { timers_.push_back({fd, 0, 0}); }

    // The life of a thread.
    int create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
               void* argument);
    /// Returns when the thread does nothing of ours any more.
    void waitForEnd(pthread_t thread);

    [[nodiscard]] std::uint64_t random() { return random_(); }
    [[nodiscard]] std::uint64_t turns() const { return turns_; }

private:
    struct Task;
    struct Timer {
        int fd;
        Ns next, period;
    };

    Scheduler();
    static void* begin(void* task);
    static void end(void* task);
    void passTurn(Task& self);
    [[nodiscard]] Task& next();
    void expire();
    void checkFiles();
    void advance();
    void makeReady(Task& task, bool woken);
    static void giveTurn(Task& to);
    static void awaitTurn(Task& self);

    Ns now_ = 1000 * kSecond;
    Ns wallOffset_ = 1'790'000'000 * kSecond;
    Ns cost_ = 500;
    std::vector<Task*> tasks_, ready_;
    std::vector<Timer> timers_;
    std::mt19937_64 random_;
    std::uint64_t turns_ = 0, order_ = 0, locks_ = 0;
    int filesWaited_ = 0, idle_ = 0;
    pthread_key_t atEnd_{};
};

}  // namespace mfar::faults
