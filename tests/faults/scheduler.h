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

/// Runs the threads of this process one at a time on a simulated clock. Each reading advances the
/// clock a little. If every thread waits, the clock jumps to the next deadline, so that waiting
/// takes no time. A seed determines the next thread, so that runs can be repeated. A thread gives
/// up its turn where it waits (see calls.cpp), and sometimes where it locks. Only the thread with
/// the turn changes this object, so that it needs no lock.
class Scheduler {
public:
    /// Created by the first call. Never destroyed, because threads outlive main().
    static Scheduler& get();

    /// False in a thread that has given up its last turn and is being cleaned up by the C library.
    [[nodiscard]] bool hasTurn() const;

    [[nodiscard]] Ns now() const { return now_; }
    [[nodiscard]] Ns look() { return now_ += cost_; }
    void setCost(Ns cost) { cost_ = cost; }
    [[nodiscard]] Ns wallOffset() const { return wallOffset_; }
    void stepWall(Ns by) { wallOffset_ += by; }

    /// Waits until wake() is called with this key. Returns false if the deadline comes first.
    bool waitFor(const void* key, Ns deadline = kNever);
    /// Wakes the first `count` tasks that wait with this key. Returns the number of woken tasks.
    int wake(const void* key, int count = std::numeric_limits<int>::max());
    /// Like poll(). Returns -1 with errno if poll() does.
    int waitForFiles(pollfd* fds, nfds_t count, Ns deadline);
    void yield();
    /// Gives other tasks a turn in one of 16 calls on average, chosen at random.
    void maybeYield();

    /// Makes a timer's descriptor readable at `first` (0: never), and then every `period` (0:
    /// once).
    void setTimer(int fd, Ns first, Ns period);
    void addTimer(int fd) { timers_.push_back({fd, 0, 0}); }

    int create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
               void* argument);
    /// Returns when the thread has given up its last turn.
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
    std::uint64_t turns_ = 0, order_ = 0;
    int filesWaited_ = 0, idle_ = 0;
    pthread_key_t atEnd_{};
};

}  // namespace mfar::faults
