#pragma once

#include "base/owned_fd.h"

#include <chrono>

namespace mfar {

struct Event {
    enum class Kind {
        Signal,    ///< SIGINT, SIGTERM or SIGHUP arrived
        Tick,      ///< a period of tickEvery() has passed
        Deadline,  ///< the time set by deadlineIn() has come
        Wake,      ///< wake() was called
    };
    Kind kind;
    int signal = 0;
};

/// The events that the main thread waits for. Once this is constructed, SIGINT, SIGTERM and SIGHUP
/// arrive only here: they are blocked in the constructing thread and in all threads that it starts
/// later.
class Events {
public:
    /// Throws std::system_error.
    Events();

    /// Waits for the next event. Signals come before all others.
    [[nodiscard]] Event wait();
    void tickEvery(std::chrono::duration<double> period);
    /// Replaces an earlier deadline.
    void deadlineIn(std::chrono::duration<double> time);
    /// May be called from any thread.
    void wake();

private:
    OwnedFd epoll_;
    OwnedFd signals_;
    OwnedFd tick_;
    OwnedFd deadline_;
    OwnedFd wake_;
};

}  // namespace mfar
