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

/// Runs the threads of this process one at a time on a simulated clock. The clock advances a little
/// with each reading and jumps to the next deadline when every thread waits; so an hour of waiting
/// costs nothing. The next thread is drawn from a seed; so a run can be repeated.
///
/// A thread gives up its turn where it waits (see calls.cpp), and sometimes where it locks. Only
/// the thread that has the turn calls these functions; so they need no lock.
class Scheduler {
public:
    /// Created by the first call. Never destroyed, because threads outlive main().
    static Scheduler& get();

    /// False in a thread that has given up its turn for good, during the last clean-up by the C
    /// library.
    [[nodiscard]] bool hasTurn() const;

    [[nodiscard]] Ns now() const { return now_; }
    /// Advances the clock by the cost of a reading and returns it.
    [[nodiscard]] Ns look() { return now_ += cost_; }
    void setCost(Ns cost) { cost_ = cost; }
    /// Offset of CLOCK_REALTIME from the other clocks.
    [[nodiscard]] Ns wallOffset() const { return wallOffset_; }
    void stepWall(Ns by) { wallOffset_ += by; }

    /// Waits until wake() is called with this key. Returns false at the deadline.
    bool waitFor(const void* key, Ns deadline = kNever);
    /// Wakes the first `count` tasks that wait with this key. Returns the number of tasks woken.
    int wake(const void* key, int count = std::numeric_limits<int>::max());
    /// Like poll(), including -1 with errno.
    int waitForFiles(pollfd* fds, nfds_t count, Ns deadline);
    /// Gives other tasks a turn.
    void yield();
    /// Gives other tasks a turn in a random share of the calls.
    void maybeYield();

    /// Makes a timer's descriptor readable at `first` (0: never), and then every `period` (0: only
    /// once).
    void setTimer(int fd, Ns first, Ns period);
    void addTimer(int fd) { timers_.push_back({fd, 0, 0}); }

    // Start and end of threads.
    int create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
               void* argument);
    /// Returns when the thread no longer executes code of this process.
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
