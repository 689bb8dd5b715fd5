#pragma once

#include "base/time.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mfar {

/// A thread's role decides what happens when it hangs.
enum class ThreadRole {
    Vital,   ///< the picture or the output needs it: the process has to be restarted
    Helper,  ///< files, configuration: the picture continues, and the fault is reported
};

/// The heartbeats of all threads; one thread checks them. Thread-safe. See Heartbeat.
class Heartbeats {
public:
    using Clock = std::function<Timestamp()>;

    explicit Heartbeats(Clock clock = &Timestamp::now) : clock_(std::move(clock)) {}
    Heartbeats(const Heartbeats&) = delete;
    Heartbeats& operator=(const Heartbeats&) = delete;

    struct Late {
        std::string thread;
        ThreadRole role = ThreadRole::Vital;
        std::chrono::nanoseconds since{0};  ///< time of its last beat
    };
    /// The working threads whose last beat is older than `patience` times their budget, longest
    /// silence first.
    [[nodiscard]] std::vector<Late> late(int patience = 1) const;

    struct Waiting {
        std::string thread;
        ThreadRole role = ThreadRole::Vital;
        std::string what;
        std::chrono::nanoseconds since{0};
    };
    /// The thread that has waited longest for something that it has named with restFor(); empty if
    /// no thread has.
    [[nodiscard]] std::optional<Waiting> waiting() const;

private:
    friend class Heartbeat;
    struct Slot {
        std::string thread;
        std::chrono::nanoseconds budget;
        ThreadRole role;
        std::atomic<std::int64_t> at;  ///< time of the last beat, or of the start of a wait
        std::atomic<const char*> waitsFor{nullptr};  ///< null: the thread works
    };

    const Clock clock_;
    mutable std::mutex mutex_;
    std::list<Slot> slots_;
};

/// Registers the threads that a class starts. The class uses `all` as long as it lives.
struct WatchedThread {
    Heartbeats* all = nullptr;  ///< null: the thread is not watched
    std::string name{};
    std::chrono::nanoseconds budget{0};
    ThreadRole role = ThreadRole::Vital;
};

/// The heartbeat of one thread. The thread calls beat() in each round of its loop, before anything
/// that may hang, and rest() before it waits for work, as waiting is not a fault. The thread counts
/// as working from construction on and is no longer watched after destruction. Costs one clock
/// reading and two stores; used by one thread.
class Heartbeat {
public:
    /// `budget`: upper limit of the time from one beat to the next. `all` must outlive this.
    Heartbeat(Heartbeats& all, std::string thread, std::chrono::nanoseconds budget,
              ThreadRole role = ThreadRole::Vital);
    /// Without `as.all`, does nothing.
    explicit Heartbeat(const WatchedThread& as);
    Heartbeat(const Heartbeat&) = delete;
    Heartbeat& operator=(const Heartbeat&) = delete;
    ~Heartbeat();

    void beat();
    /// The thread waits for work until the next beat().
    void rest() { restFor(""); }
    /// As rest(), but the thread waits for a named party whose absence is worth reporting: "the
    /// reader of the pipe". The text must outlive this.
    void restFor(const char* what);

private:
    Heartbeats* all_;  ///< null: the thread is not watched
    std::list<Heartbeats::Slot>::iterator slot_;
};

}  // namespace mfar
