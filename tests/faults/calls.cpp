// Replaces functions of the C library that wait or read the time. The new versions wait in the
// Scheduler and read its simulated clock. Locks remain those of the C library. A thread that finds
// a lock taken waits in the Scheduler and tries again.

#include "tests/faults/real_calls.h"
#include "tests/faults/scheduler.h"

#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <dlfcn.h>
#include <errno.h>
#include <sched.h>
#include <semaphore.h>
#include <set>
#include <time.h>

#define MFAR_TAKES_OVER extern "C" __attribute__((visibility("default")))

namespace mfar::faults {
namespace {

template <class F>
void find(F*& function, const char* name) {
    function = reinterpret_cast<F*>(dlsym(RTLD_NEXT, name));
}

RealCalls findAll() {
    RealCalls r{};
    find(r.clock, "clock_gettime");
    find(r.syscall, "syscall");
    find(r.poll, "poll");
    find(r.create, "pthread_create");
    find(r.join, "pthread_join");
    find(r.lock, "pthread_mutex_lock");
    find(r.tryLock, "pthread_mutex_trylock");
    find(r.unlock, "pthread_mutex_unlock");
    find(r.condInit, "pthread_cond_init");
    find(r.once, "pthread_once");
    find(r.tryRead, "pthread_rwlock_tryrdlock");
    find(r.tryWrite, "pthread_rwlock_trywrlock");
    find(r.unlockShared, "pthread_rwlock_unlock");
    find(r.tryTake, "sem_trywait");
    find(r.post, "sem_post");
    find(r.exitNow, "_exit");
    return r;
}

}  // namespace

const RealCalls& real() {
    static RealCalls calls;
    if (calls.clock == nullptr) calls = findAll();
    return calls;
}

namespace {

Ns nsOf(const timespec& t) {
    return static_cast<Ns>(t.tv_sec) * kSecond + t.tv_nsec;
}

timespec timespecOf(Ns t) {
    return {static_cast<time_t>(t / kSecond), static_cast<long>(t % kSecond)};
}

bool isWall(clockid_t clock) {
    return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE;
}

bool isOurs(clockid_t clock) {
    return isWall(clock) || clock == CLOCK_MONOTONIC || clock == CLOCK_MONOTONIC_RAW ||
           clock == CLOCK_MONOTONIC_COARSE || clock == CLOCK_BOOTTIME;
}

/// Converts a time to the scheduler's clock. A step of the wall clock does not move deadlines of
/// current waits.
Ns deadlineOf(clockid_t clock, const timespec* time) {
    if (time == nullptr) return kNever;
    return nsOf(*time) - (isWall(clock) ? Scheduler::get().wallOffset() : 0);
}

Ns deadlineIn(Ns time) {
    return Scheduler::get().look() + std::max<Ns>(time, 0);
}

/// Repeats `attempt` while it returns EBUSY. Returns its first other result, or ETIMEDOUT at the
/// deadline. The release of a lock wakes one or all of the threads that wait with the lock's key.
template <class Attempt>
int lockWith(const void* key, Attempt attempt, Ns deadline = kNever) {
    Scheduler& all = Scheduler::get();
    all.maybeYield();
    for (;;) {
        const int error = attempt();
        if (error != EBUSY) return error;
        if (!all.waitFor(key, deadline)) return ETIMEDOUT;
    }
}

int lock(pthread_mutex_t* mutex, Ns deadline = kNever) {
    if (!Scheduler::get().hasTurn()) return real().lock(mutex);
    return lockWith(mutex, [&] { return real().tryLock(mutex); }, deadline);
}

int unlock(pthread_mutex_t* mutex) {
    const int error = real().unlock(mutex);
    if (Scheduler::get().hasTurn()) Scheduler::get().wake(mutex, 1);
    return error;
}

std::set<const pthread_cond_t*>& monotonicConditions() {
    static auto* all = new std::set<const pthread_cond_t*>;
    return *all;
}

int waitFor(pthread_cond_t* condition, pthread_mutex_t* mutex, Ns deadline) {
    Scheduler& all = Scheduler::get();
    const int error = real().unlock(mutex);
    if (error != 0) return error;
    all.wake(mutex, 1);
    const bool woken = all.waitFor(condition, deadline);
    lockWith(mutex, [&] { return real().tryLock(mutex); });
    return woken ? 0 : ETIMEDOUT;
}

long futex(int* word, int operation, long value, const timespec* time) {
    Scheduler& all = Scheduler::get();
    const int what = operation & FUTEX_CMD_MASK;
    if (what == FUTEX_WAKE || what == FUTEX_WAKE_BITSET)
        return all.wake(word, static_cast<int>(value));
    all.maybeYield();
    if (__atomic_load_n(word, __ATOMIC_SEQ_CST) != static_cast<int>(value)) {
        errno = EAGAIN;
        return -1;
    }
    Ns deadline = kNever;
    if (time != nullptr && what == FUTEX_WAIT) deadline = deadlineIn(nsOf(*time));
    if (time != nullptr && what == FUTEX_WAIT_BITSET)
        deadline = deadlineOf(
            (operation & FUTEX_CLOCK_REALTIME) != 0 ? CLOCK_REALTIME : CLOCK_MONOTONIC, time);
    if (all.waitFor(word, deadline)) return 0;
    errno = ETIMEDOUT;
    return -1;
}

bool isFutexWaitOrWake(int operation) {
    const int what = operation & FUTEX_CMD_MASK;
    return what == FUTEX_WAIT || what == FUTEX_WAIT_BITSET || what == FUTEX_WAKE ||
           what == FUTEX_WAKE_BITSET;
}

void sleepUntil(Ns deadline) {
    char here = 0;
    Scheduler::get().waitFor(&here, deadline);
}

}  // namespace
}  // namespace mfar::faults

using namespace mfar::faults;

MFAR_TAKES_OVER int clock_gettime(clockid_t clock, timespec* out) noexcept {
    if (!isOurs(clock)) return real().clock(clock, out);
    Scheduler& all = Scheduler::get();
    const Ns now = all.hasTurn() ? all.look() : all.now();
    *out = timespecOf(now + (isWall(clock) ? all.wallOffset() : 0));
    return 0;
}

MFAR_TAKES_OVER int gettimeofday(timeval* out, void*) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    *out = {now.tv_sec, now.tv_nsec / 1000};
    return 0;
}

MFAR_TAKES_OVER time_t time(time_t* out) noexcept {
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    if (out != nullptr) *out = now.tv_sec;
    return now.tv_sec;
}

MFAR_TAKES_OVER int clock_nanosleep(clockid_t clock, int flags, const timespec* t, timespec*) {
    sleepUntil((flags & TIMER_ABSTIME) != 0 ? deadlineOf(clock, t) : deadlineIn(nsOf(*t)));
    return 0;
}

MFAR_TAKES_OVER int nanosleep(const timespec* t, timespec*) {
    sleepUntil(deadlineIn(nsOf(*t)));
    return 0;
}

MFAR_TAKES_OVER int usleep(useconds_t us) {
    sleepUntil(deadlineIn(static_cast<Ns>(us) * 1000));
    return 0;
}

MFAR_TAKES_OVER int sched_yield() noexcept {
    if (Scheduler::get().hasTurn()) Scheduler::get().yield();
    return 0;
}

MFAR_TAKES_OVER int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                                   void* (*start)(void*), void* argument) noexcept {
    return Scheduler::get().create(thread, attributes, start, argument);
}

MFAR_TAKES_OVER int pthread_join(pthread_t thread, void** result) {
    Scheduler::get().waitForEnd(thread);
    return real().join(thread, result);
}

MFAR_TAKES_OVER int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
    return lock(mutex);
}

MFAR_TAKES_OVER int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* t) noexcept {
    return lock(mutex, deadlineOf(CLOCK_REALTIME, t));
}

MFAR_TAKES_OVER int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                            const timespec* t) noexcept {
    return lock(mutex, deadlineOf(clock, t));
}

MFAR_TAKES_OVER int pthread_mutex_unlock(pthread_mutex_t* mutex) noexcept {
    return unlock(mutex);
}

MFAR_TAKES_OVER int pthread_cond_init(pthread_cond_t* condition,
                                      const pthread_condattr_t* attributes) noexcept {
    clockid_t clock = CLOCK_REALTIME;
    if (attributes != nullptr) pthread_condattr_getclock(attributes, &clock);
    if (isWall(clock))
        monotonicConditions().erase(condition);
    else
        monotonicConditions().insert(condition);
    return real().condInit(condition, attributes);
}

MFAR_TAKES_OVER int pthread_cond_destroy(pthread_cond_t* condition) noexcept {
    monotonicConditions().erase(condition);
    return 0;
}

MFAR_TAKES_OVER int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
    return waitFor(condition, mutex, kNever);
}

MFAR_TAKES_OVER int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                           const timespec* t) {
    const bool monotonic = monotonicConditions().contains(condition);
    return waitFor(condition, mutex, deadlineOf(monotonic ? CLOCK_MONOTONIC : CLOCK_REALTIME, t));
}

MFAR_TAKES_OVER int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                           clockid_t clock, const timespec* t) {
    return waitFor(condition, mutex, deadlineOf(clock, t));
}

MFAR_TAKES_OVER int pthread_cond_signal(pthread_cond_t* condition) noexcept {
    if (Scheduler::get().hasTurn()) Scheduler::get().wake(condition, 1);
    return 0;
}

MFAR_TAKES_OVER int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
    if (Scheduler::get().hasTurn()) Scheduler::get().wake(condition);
    return 0;
}

MFAR_TAKES_OVER int pthread_once(pthread_once_t* control, void (*work)()) {
    static auto* underWay = new std::set<const pthread_once_t*>;
    Scheduler& all = Scheduler::get();
    while (underWay->contains(control))
        all.waitFor(control);
    underWay->insert(control);
    const struct AtEnd {
        pthread_once_t* control;
        ~AtEnd() {
            underWay->erase(control);
            Scheduler::get().wake(control);
        }
    } atEnd{control};
    return real().once(control, work);
}

MFAR_TAKES_OVER int pthread_rwlock_rdlock(pthread_rwlock_t* shared) noexcept {
    return lockWith(shared, [&] { return real().tryRead(shared); });
}

MFAR_TAKES_OVER int pthread_rwlock_wrlock(pthread_rwlock_t* shared) noexcept {
    return lockWith(shared, [&] { return real().tryWrite(shared); });
}

MFAR_TAKES_OVER int pthread_rwlock_unlock(pthread_rwlock_t* shared) noexcept {
    const int error = real().unlockShared(shared);
    if (Scheduler::get().hasTurn()) Scheduler::get().wake(shared);
    return error;
}

MFAR_TAKES_OVER int sem_wait(sem_t* semaphore) {
    return lockWith(semaphore, [&] { return real().tryTake(semaphore) == 0 ? 0 : EBUSY; });
}

MFAR_TAKES_OVER int sem_post(sem_t* semaphore) noexcept {
    const int error = real().post(semaphore);
    if (Scheduler::get().hasTurn()) Scheduler::get().wake(semaphore, 1);
    return error;
}

// Replaced because the C++ library uses futexes for futures, atomics and static objects.
MFAR_TAKES_OVER long syscall(long number, ...) noexcept {
    va_list rest;
    va_start(rest, number);
    long a[6];
    for (long& one : a)
        one = va_arg(rest, long);
    va_end(rest);
    if (number == SYS_futex && isFutexWaitOrWake(static_cast<int>(a[1])) &&
        Scheduler::get().hasTurn())
        return futex(reinterpret_cast<int*>(a[0]), static_cast<int>(a[1]), a[2],
                     reinterpret_cast<const timespec*>(a[3]));
    return real().syscall(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

MFAR_TAKES_OVER int poll(pollfd* fds, nfds_t count, int ms) {
    Scheduler& all = Scheduler::get();
    if (!all.hasTurn()) return real().poll(fds, count, ms);
    return all.waitForFiles(fds, count, ms < 0 ? kNever : deadlineIn(ms * kMs));
}

MFAR_TAKES_OVER int ppoll(pollfd* fds, nfds_t count, const timespec* t, const sigset_t*) {
    return Scheduler::get().waitForFiles(fds, count, t == nullptr ? kNever : deadlineIn(nsOf(*t)));
}

MFAR_TAKES_OVER int epoll_wait(int epoll, epoll_event* events, int most, int ms) {
    pollfd readable{epoll, POLLIN, 0};
    Scheduler::get().waitForFiles(&readable, 1, ms < 0 ? kNever : deadlineIn(ms * kMs));
    return static_cast<int>(real().syscall(SYS_epoll_pwait, epoll, events, most, 0, nullptr, 8));
}

MFAR_TAKES_OVER int sigtimedwait(const sigset_t* set, siginfo_t* info, const timespec* t) {
    const Ns end = t == nullptr ? kNever : deadlineIn(nsOf(*t));
    for (;;) {
        constexpr timespec kNow{};
        const int signal = static_cast<int>(
            real().syscall(SYS_rt_sigtimedwait, set, info, &kNow, sizeof(unsigned long)));
        if (signal > 0 || errno != EAGAIN || Scheduler::get().now() >= end) return signal;
        sleepUntil(std::min(end, deadlineIn(10 * kMs)));
    }
}

// Replaces a timer by an event descriptor to which the scheduler writes.
MFAR_TAKES_OVER int timerfd_create(int, int flags) noexcept {
    const int fd = eventfd(0, ((flags & TFD_CLOEXEC) != 0 ? EFD_CLOEXEC : 0) | EFD_NONBLOCK);
    if (fd >= 0) Scheduler::get().addTimer(fd);
    return fd;
}

MFAR_TAKES_OVER int timerfd_settime(int fd, int flags, const itimerspec* to,
                                    itimerspec* before) noexcept {
    Scheduler& all = Scheduler::get();
    if (before != nullptr) *before = {};
    const Ns first = nsOf(to->it_value);
    const Ns at = (flags & TFD_TIMER_ABSTIME) != 0 ? first : all.look() + first;
    all.setTimer(fd, first == 0 ? 0 : at, nsOf(to->it_interval));
    return 0;
}
