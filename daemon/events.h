#pragma once

#include <chrono>

namespace mfar {

/// An open file descriptor, closed at the end.
class Fd {
public:
    /// Throws std::system_error with `what` when `fd` is negative (errno tells why).
    Fd(int fd, const char* what);
    Fd(const Fd&) = delete;
    Fd& operator=(const Fd&) = delete;
    ~Fd();

    [[nodiscard]] int get() const { return fd_; }

private:
    int fd_;
};

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
    Fd epoll_;
    Fd signals_;
    Fd tick_;
    Fd deadline_;
    Fd wake_;
};

}  // namespace mfar
