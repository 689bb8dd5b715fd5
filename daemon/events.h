#pragma once

#include "base/owned_fd.h"

#include <chrono>

namespace mfar {

struct Event {
    enum class Kind {
        Signal,
        Tick,
        Deadline,
        Wake,
    };
    Kind kind;
    int signal = 0;
};

/// Reports the events for which the main thread waits. The constructor blocks SIGINT, SIGTERM and
/// SIGHUP in the calling thread and in all threads that this thread starts later. So these signals
/// are reported by this class only.
class Events {
public:
    /// Throws std::system_error.
    Events();

    /// Waits for the next event. Signals are reported before all other events.
    [[nodiscard]] Event wait();
    void tickEvery(std::chrono::duration<double> period);
    /// Requests one Deadline event after this time. Replaces the previous request.
    void deadlineIn(std::chrono::duration<double> time);
    /// Causes a Wake event. Thread-safe.
    void wake();

private:
    OwnedFd epoll_;
    OwnedFd signals_;
    OwnedFd tick_;
    OwnedFd deadline_;
    OwnedFd wake_;
};

/// While an object of this class exists, SIGINT and SIGTERM end the process at once. Only the
/// thread that owns the Events object may create it.
class SignalsEndProcess {
public:
    SignalsEndProcess();
    SignalsEndProcess(const SignalsEndProcess&) = delete;
    SignalsEndProcess& operator=(const SignalsEndProcess&) = delete;
    ~SignalsEndProcess();
};

}  // namespace mfar
