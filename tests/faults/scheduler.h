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

/// Runs the threads of this process one at a time on a simulated clock, which advances a little
/// with each reading and jumps to the next deadline when every thread waits. So an hour of waiting
/// costs nothing; and as the next thread is drawn from a seed, a run can be repeated.
///
/// A thread gives up its turn where it waits (see calls.cpp), and sometimes where it locks. Only
/// the thread with the turn calls these functions, so nothing here is locked.
class Scheduler {
public:
    /// Created by the first call; never destroyed, as threads outlive main().
    static Scheduler& get();

    /// False in a thread that has given up its turn permanently, during the C library's last
    /// clean-up.
    [[nodiscard]] bool hasTurn() const;

    [[nodiscard]] Ns now() const { return now_; }
    /// Reads the clock, after advancing it by the cost of a reading.
    [[nodiscard]] Ns look() { return now_ += cost_; }
    void setCost(Ns cost) { cost_ = cost; }
    /// Offset of CLOCK_REALTIME from the other clocks.
    [[nodiscard]] Ns wallOffset() const { return wallOffset_; }
    void stepWall(Ns by) { wallOffset_ += by; }

    /// Waits for a wake() with this key; false at the deadline.
    bool waitFor(const void* key, Ns deadline = kNever);
    /// Wakes the first `count` waiting tasks; returns their number.
    int wake(const void* key, int count = std::numeric_limits<int>::max());
    /// As poll(), including -1 with errno.
    int waitForFiles(pollfd* fds, nfds_t count, Ns deadline);
    /// Gives other tasks a turn.
    void yield();
    /// Yields at some of the calls.
    void maybeYield();

    /// Makes a timer's descriptor readable at `first` (0: never), then every `period` (0: only
    /// once).
    void setTimer(int fd, Ns first, Ns period);
    void addTimer(int fd) { timers_.push_back({fd, 0, 0}); }

    // Start and end of threads.
    int create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
               void* argument);
    /// Returns when the thread executes no more code of this process.
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
