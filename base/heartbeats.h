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
    Vital,   ///< the picture or the way out need it: the process has to be started again
    Helper,  ///< files, configuration: the picture goes on, and the fault is reported
};

/// The heartbeats of all threads, which one of them looks at. Thread-safe. See Heartbeat.
class Heartbeats {
public:
    using Clock = std::function<Timestamp()>;

    explicit Heartbeats(Clock clock = &Timestamp::now) : clock_(std::move(clock)) {}
    Heartbeats(const Heartbeats&) = delete;
    Heartbeats& operator=(const Heartbeats&) = delete;

    struct Late {
        std::string thread;
        ThreadRole role = ThreadRole::Vital;
        std::chrono::nanoseconds since{0};  ///< its last beat
    };
    /// The threads that work and have not beaten for longer than `patience` times their budget, the
    /// one that is silent for longest first.
    [[nodiscard]] std::vector<Late> late(int patience = 1) const;

    struct Waiting {
        std::string thread;
        ThreadRole role = ThreadRole::Vital;
        std::string what;
        std::chrono::nanoseconds since{0};
    };
    /// The thread that has waited longest for something that it has named; nothing where none does.
    [[nodiscard]] std::optional<Waiting> waiting() const;

private:
    friend class Heartbeat;
    struct Slot {
        std::string thread;
        std::chrono::nanoseconds budget;
        ThreadRole role;
        std::atomic<std::int64_t> at;  ///< of the last beat, or of the begin of a wait
        std::atomic<const char*> waitsFor{nullptr};  ///< null: it works
    };

    const Clock clock_;
    mutable std::mutex mutex_;
    std::list<Slot> slots_;
};

/// Tells a class how to watch the threads that it starts. The class uses `all` as long as it lives.
struct WatchedThread {
    Heartbeats* all = nullptr;  ///< null: nobody watches
    std::string name{};
    std::chrono::nanoseconds budget{0};
    ThreadRole role = ThreadRole::Vital;
};

/// One thread says that it is alive: beat() in each round of its loop, before anything that may
/// hang, and rest() before it waits for work, as waiting is no fault. The thread counts as working
/// from the construction on and is no longer watched after the destruction. Costs one look at the
/// clock and two stores; used by one thread.
class Heartbeat {
public:
    /// `budget`: the longest time from one beat to the next. `all` must outlive this.
    Heartbeat(Heartbeats& all, std::string thread, std::chrono::nanoseconds budget,
              ThreadRole role = ThreadRole::Vital);
    /// Does nothing where nobody watches.
    explicit Heartbeat(const WatchedThread& as);
    Heartbeat(const Heartbeat&) = delete;
    Heartbeat& operator=(const Heartbeat&) = delete;
    ~Heartbeat();

    void beat();
    /// It waits for work until the next beat().
    void rest() { restFor(""); }
    /// The same where somebody else is to do something, which people want to know: "the reader of
    /// the pipe". The text must outlive this.
    void restFor(const char* what);

private:
    Heartbeats* all_;  ///< null: nobody watches
    std::list<Heartbeats::Slot>::iterator slot_;
};

}  // namespace mfar
