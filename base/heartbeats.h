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

enum class ThreadRole {
    Vital,   ///< no picture or output without this thread; if it hangs, the process must restart
    Helper,  ///< e.g. a writer of files; if it hangs, pictures continue and a fault is reported
};

/// The heartbeats of all threads, see Heartbeat. One thread checks them. Thread-safe.
class Heartbeats {
public:
    using Clock = std::function<Timestamp()>;

    explicit Heartbeats(Clock clock = &Timestamp::now) : clock_(std::move(clock)) {}
    Heartbeats(const Heartbeats&) = delete;
    Heartbeats& operator=(const Heartbeats&) = delete;

    struct Late {
        std::string thread;
        ThreadRole role = ThreadRole::Vital;
        std::chrono::nanoseconds since{0};
    };
    /// Returns the working threads whose last beat is older than `patience` times their budget. The
    /// thread with the oldest beat comes first.
    [[nodiscard]] std::vector<Late> late(int patience = 1) const;

    struct Waiting {
        std::string thread;
        ThreadRole role = ThreadRole::Vital;
        std::string what;
        std::chrono::nanoseconds since{0};
    };
    /// Returns the thread that has waited longest since it called restFor(), or nothing if no
    /// thread waits after such a call. Threads that called rest() are not reported.
    [[nodiscard]] std::optional<Waiting> waiting() const;

private:
    friend class Heartbeat;
    struct Slot {
        std::string thread;
        std::chrono::nanoseconds budget;
        ThreadRole role;
        std::atomic<std::int64_t> at;  ///< [ns]; time of the last beat, or of the start of a wait
        std::atomic<const char*> waitsFor{nullptr};  ///< null: the thread works
    };

    const Clock clock_;
    mutable std::mutex mutex_;
    std::list<Slot> slots_;
};

/// The name, role and time budget of a thread that a class starts and registers. `all` must outlive
/// the thread.
struct WatchedThread {
    Heartbeats* all = nullptr;  ///< null: the thread is not watched
    std::string name{};
    std::chrono::nanoseconds budget{0};
    ThreadRole role = ThreadRole::Vital;
};

/// The heartbeat of one thread; only this thread may use it. The thread calls beat() in each
/// iteration of its loop, before any operation that may hang. It calls rest() before it waits for
/// work, because waiting is not a fault. The thread is watched from the construction of this object
/// until the object's destruction. At first, the thread counts as working. A call of beat() or
/// rest() costs one clock reading and two stores.
class Heartbeat {
public:
    /// `budget`: the longest allowed time between two beats. `all` must outlive this object.
    Heartbeat(Heartbeats& all, std::string thread, std::chrono::nanoseconds budget,
              ThreadRole role = ThreadRole::Vital);
    explicit Heartbeat(const WatchedThread& as);
    Heartbeat(const Heartbeat&) = delete;
    Heartbeat& operator=(const Heartbeat&) = delete;
    ~Heartbeat();

    void beat();
    /// Marks the thread as waiting for work until the next beat().
    void rest() { restFor(""); }
    /// Works like rest(), but waiting() reports the thread and `what`, e.g. "the reader of the
    /// pipe". The text must outlive this object.
    void restFor(const char* what);

private:
    Heartbeats* all_;
    std::list<Heartbeats::Slot>::iterator slot_;
};

}  // namespace mfar
