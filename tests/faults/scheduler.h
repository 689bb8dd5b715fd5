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

/// Runs the threads of this process one at a time, on a clock of its own: the clock advances a
/// little each time it is read, and jumps to the next deadline when every thread waits. An hour of
/// waiting thus takes no time, and a run can be repeated, as a seed determines the order of
/// threads.
///
/// A thread passes its turn on when it waits (see calls.cpp), and sometimes when it locks. All
/// functions are called by the thread that has the turn, so that no locks are needed here.
class Scheduler {
public:
    /// Created by the first call; never destroyed, as threads outlive main().
    static Scheduler& get();

    /// False in a thread that has given up its turn for ever, during the C library's last clean-up.
    [[nodiscard]] bool hasTurn() const;

    [[nodiscard]] Ns now() const { return now_; }
    /// Reads the clock, which advances it.
    [[nodiscard]] Ns look() { return now_ += cost_; }
    void setCost(Ns cost) { cost_ = cost; }
    /// CLOCK_REALTIME minus the other clocks.
    [[nodiscard]] Ns wallOffset() const { return wallOffset_; }
    void stepWall(Ns by) { wallOffset_ += by; }

    /// Waits until wake() with this key; false when the deadline has passed.
    bool waitFor(const void* key, Ns deadline = kNever);
    /// Wakes the first threads that wait for the key, at most `count`; returns their number.
    int wake(const void* key, int count = std::numeric_limits<int>::max());
    /// As poll(), including -1 with errno.
    int waitForFiles(pollfd* fds, nfds_t count, Ns deadline);
    /// Lets other threads run first.
    void yield();
    /// As yield(), but only sometimes.
    void maybeYield();

    /// A timer's descriptor becomes readable at `first` (0: never), then every `period` (0: only
    /// once).
    void setTimer(int fd, Ns first, Ns period);
    void addTimer(int fd) { timers_.push_back({fd, 0, 0}); }

    // The life of a thread.
    int create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
               void* argument);
    /// Returns when the thread no longer runs code of this library.
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
