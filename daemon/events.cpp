#include "daemon/events.h"

#include <pthread.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <system_error>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace mfar {
namespace {

/// Blocks or unblocks the signals in this thread (`how`: SIG_BLOCK or SIG_UNBLOCK). Returns the set
/// of these signals.
sigset_t mask(int how, std::initializer_list<int> signals) {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : signals)
        sigaddset(&set, signal);
    pthread_sigmask(how, &set, nullptr);
    return set;
}

int openSignals() {
    const sigset_t set = mask(SIG_BLOCK, {SIGINT, SIGTERM, SIGHUP});
    return signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

void arm(const OwnedFd& timer, std::chrono::duration<double> time, bool repeat) {
    const double s = std::max(time.count(), 1e-6);
    timespec at{};
    at.tv_sec = static_cast<time_t>(s);
    at.tv_nsec = static_cast<long>((s - std::floor(s)) * 1e9);
    const itimerspec spec{repeat ? at : timespec{}, at};
    if (timerfd_settime(timer.get(), 0, &spec, nullptr) != 0)
        throw std::system_error(errno, std::generic_category(), "timer");
}

bool drained(const OwnedFd& fd) {
    std::uint64_t count = 0;
    return read(fd.get(), &count, sizeof count) == sizeof count;
}

}  // namespace

Events::Events()
    : epoll_(opened(epoll_create1(EPOLL_CLOEXEC), "epoll")),
      signals_(opened(openSignals(), "signalfd")),
      tick_(opened(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK), "timerfd")),
      deadline_(opened(timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK), "timerfd")),
      wake_(opened(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "eventfd")) {
    for (const OwnedFd* fd : {&signals_, &tick_, &deadline_, &wake_}) {
        epoll_event interest{};
        interest.events = EPOLLIN;
        if (epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd->get(), &interest) != 0)
            throw std::system_error(errno, std::generic_category(), "epoll");
    }
}

Event Events::wait() {
    for (;;) {
        signalfd_siginfo info{};
        if (read(signals_.get(), &info, sizeof info) == sizeof info)
            return {Event::Kind::Signal, static_cast<int>(info.ssi_signo)};
        if (drained(wake_)) return {Event::Kind::Wake};
        if (drained(deadline_)) return {Event::Kind::Deadline};
        if (drained(tick_)) return {Event::Kind::Tick};
        epoll_event ready{};
        if (epoll_wait(epoll_.get(), &ready, 1, -1) < 0 && errno != EINTR)
            throw std::system_error(errno, std::generic_category(), "epoll");
    }
}

SignalsEndProcess::SignalsEndProcess() {
    mask(SIG_UNBLOCK, {SIGINT, SIGTERM});
}

SignalsEndProcess::~SignalsEndProcess() {
    mask(SIG_BLOCK, {SIGINT, SIGTERM});
}

void Events::tickEvery(std::chrono::duration<double> period) {
    arm(tick_, period, true);
}

void Events::deadlineIn(std::chrono::duration<double> time) {
    arm(deadline_, time, false);
}

void Events::wake() {
    const std::uint64_t one = 1;
    // write() fails only if the eventfd's counter is at its maximum. The main thread wakes up even
    // then.
    [[maybe_unused]] const ssize_t n = write(wake_.get(), &one, sizeof one);
}

}  // namespace mfar
