#pragma once

#include "base/owned_fd.h"

#include <chrono>

namespace mfar {

struct Event {
    enum class Kind {
        Signal,    ///< SIGINT, SIGTERM or SIGHUP arrived
        Tick,      ///< the period of tickEvery() has passed
        Deadline,  ///< the time of deadlineIn() has come
        Wake,      ///< somebody called wake()
    };
    Kind kind;
    int signal = 0;
};

/// What the main thread waits for. From its construction on, SIGINT, SIGTERM and SIGHUP arrive only
/// here: they are blocked in the constructing thread and all that it starts later.
class Events {
public:
    /// Throws std::system_error.
    Events();

    /// Waits. Signals come before everything else.
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
