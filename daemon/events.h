#pragma once

#include "base/owned_fd.h"

#include <chrono>

namespace mfar {

struct Event {
    enum class Kind {
        Signal,    ///< SIGINT, SIGTERM or SIGHUP arrived
        Tick,      ///< a period of tickEvery() has passed
        Deadline,  ///< the time of deadlineIn() has passed
        Wake,      ///< wake() was called
    };
    Kind kind;
    int signal = 0;
};

/// The events for which the main thread waits. The constructor blocks SIGINT, SIGTERM and SIGHUP in
/// its thread, and so in all threads that this thread starts later. From then on, these signals are
/// reported only here.
class Events {
public:
    /// Throws std::system_error.
    Events();

    /// Waits for the next event. Signals are reported before all other events.
    [[nodiscard]] Event wait();
    void tickEvery(std::chrono::duration<double> period);
    /// Sets a deadline. An earlier deadline is replaced.
    void deadlineIn(std::chrono::duration<double> time);
    /// Causes an event Wake. Thread-safe.
    void wake();

private:
    OwnedFd epoll_;
    OwnedFd signals_;
    OwnedFd tick_;
    OwnedFd deadline_;
    OwnedFd wake_;
};

}  // namespace mfar
