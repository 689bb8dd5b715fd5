#include "tests/faults/scheduler.h"

#include "tests/faults/real_calls.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace mfar::faults {

struct Scheduler::Task {
    std::atomic<int> turn{0};
    /// Key for which the task waits; null: the task is ready. The task also wakes up if one of
    /// `files` gets ready.
    const void* key = nullptr;
    pollfd* files = nullptr;
    nfds_t fileCount = 0;
    int filesReady = 0;
    Ns deadline = kNever;
    std::uint64_t order = 0;
    bool woken = false;
    void* (*start)(void*) = nullptr;
    void* argument = nullptr;
    pthread_t thread{};
    int cleanUps = 0;
    bool ended = false;
};

namespace {

constexpr std::uint64_t kFileTurns = 16;
constexpr std::uint64_t kLocksPerYield = 16;
constexpr int kIdleMs = 100, kMostIdle = 100;

thread_local void* current = nullptr;

std::uint64_t seedOf(const char* variable) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : 1;
}

}  // namespace

Scheduler& Scheduler::get() {
    alignas(Scheduler) static unsigned char room[sizeof(Scheduler)];
    static Scheduler* all = nullptr;
    if (all == nullptr) {
        all = reinterpret_cast<Scheduler*>(room);
        new (all) Scheduler;
    }
    return *all;
}

Scheduler::Scheduler() : random_(seedOf("MFAR_FAULTS_SEED")) {
    auto* first = new Task;
    first->thread = pthread_self();
    current = first;
    tasks_.push_back(first);
    pthread_key_create(&atEnd_, &Scheduler::end);
}

bool Scheduler::hasTurn() const {
    return current != nullptr;
}

void Scheduler::giveTurn(Task& to) {
    to.turn.store(1, std::memory_order_release);
    real().syscall(SYS_futex, &to.turn, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

void Scheduler::awaitTurn(Task& self) {
    while (self.turn.exchange(0, std::memory_order_acquire) == 0)
        real().syscall(SYS_futex, &self.turn, FUTEX_WAIT_PRIVATE, 0, nullptr, nullptr, 0);
}

void Scheduler::makeReady(Task& task, bool woken) {
    if (task.files != nullptr) --filesWaited_;
    task.woken = woken;
    task.key = nullptr;
    task.files = nullptr;
    task.deadline = kNever;
    ready_.push_back(&task);
}

void Scheduler::expire() {
    for (Task* task : tasks_)
        if (task->deadline <= now_) makeReady(*task, false);
    for (Timer& timer : timers_)
        if (timer.next != 0 && timer.next <= now_) {
            std::uint64_t count = 1;
            if (timer.period > 0) {
                count = static_cast<std::uint64_t>(1 + (now_ - timer.next) / timer.period);
                timer.next += static_cast<Ns>(count) * timer.period;
            } else {
                timer.next = 0;
            }
            static_cast<void>(!write(timer.fd, &count, sizeof count));
        }
}

void Scheduler::checkFiles() {
    if (filesWaited_ == 0) return;
    for (Task* task : tasks_) {
        if (task->files == nullptr) continue;
        const int count = real().poll(task->files, task->fileCount, 0);
        if (count == 0) continue;
        task->filesReady = count;
        makeReady(*task, true);
    }
}

// Jumps to the next deadline. Without a deadline, only another process can wake a task.
void Scheduler::advance() {
    Ns first = kNever;
    for (const Task* task : tasks_)
        first = std::min(first, task->deadline);
    for (const Timer& timer : timers_)
        if (timer.next != 0) first = std::min(first, timer.next);
    if (first != kNever) {
        now_ = std::max(now_, first);
        return;
    }
    if (++idle_ > kMostIdle) {
        std::fprintf(stderr, "faults: deadlock: every thread waits for ever\n");
        std::abort();
    }
    real().poll(nullptr, 0, kIdleMs);
}

Scheduler::Task& Scheduler::next() {
    for (;;) {
        expire();
        if (ready_.empty() || ++turns_ % kFileTurns == 0) checkFiles();
        if (!ready_.empty()) break;
        advance();
    }
    idle_ = 0;
    const std::size_t at = ready_.size() == 1 ? 0 : random_() % ready_.size();
    Task* task = ready_[at];
    ready_.erase(ready_.begin() + static_cast<std::ptrdiff_t>(at));
    return *task;
}

void Scheduler::passTurn(Task& self) {
    Task& to = next();
    if (&to == &self) return;
    giveTurn(to);
    awaitTurn(self);
}

bool Scheduler::waitFor(const void* key, Ns deadline) {
    Task& self = *static_cast<Task*>(current);
    self.key = key;
    self.deadline = deadline;
    self.order = ++order_;
    passTurn(self);
    return self.woken;
}

int Scheduler::wake(const void* key, int count) {
    int woken = 0;
    while (woken < count) {
        Task* first = nullptr;
        for (Task* task : tasks_)
            if (task->key == key && (first == nullptr || task->order < first->order)) first = task;
        if (first == nullptr) break;
        makeReady(*first, true);
        ++woken;
    }
    return woken;
}

int Scheduler::waitForFiles(pollfd* fds, nfds_t count, Ns deadline) {
    const int atOnce = real().poll(fds, count, 0);
    if (atOnce != 0 || deadline <= now_) {
        maybeYield();
        return atOnce;
    }
    Task& self = *static_cast<Task*>(current);
    self.key = &self;
    self.files = fds;
    self.fileCount = count;
    self.deadline = deadline;
    self.order = ++order_;
    ++filesWaited_;
    passTurn(self);
    return self.woken ? self.filesReady : 0;
}

void Scheduler::yield() {
    Task& self = *static_cast<Task*>(current);
    now_ += cost_;
    makeReady(self, true);
    passTurn(self);
}

void Scheduler::maybeYield() {
    if (random_() % kLocksPerYield == 0) yield();
}

void Scheduler::setTimer(int fd, Ns first, Ns period) {
    for (Timer& timer : timers_)
        if (timer.fd == fd) timer = {fd, first, period};
    std::uint64_t late = 0;
    static_cast<void>(!read(fd, &late, sizeof late));
}

void* Scheduler::begin(void* argument) {
    auto* task = static_cast<Task*>(argument);
    awaitTurn(*task);
    current = task;
    pthread_setspecific(get().atEnd_, task);
    return task->start(task->argument);
}

// Destructors of thread-local data may lock. So this must run in the last round of destructors.
void Scheduler::end(void* argument) {
    auto* task = static_cast<Task*>(argument);
    if (++task->cleanUps < PTHREAD_DESTRUCTOR_ITERATIONS) {
        pthread_setspecific(get().atEnd_, task);
        return;
    }
    Scheduler& all = get();
    task->ended = true;
    all.wake(task);
    std::erase(all.tasks_, task);
    current = nullptr;
    delete task;
    giveTurn(all.next());
}

int Scheduler::create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                      void* argument) {
    auto* task = new Task;
    task->start = start;
    task->argument = argument;
    const int error = real().create(thread, attributes, &Scheduler::begin, task);
    if (error != 0) {
        delete task;
        return error;
    }
    task->thread = *thread;
    tasks_.push_back(task);
    ready_.push_back(task);
    return 0;
}

void Scheduler::waitForEnd(pthread_t thread) {
    for (Task* task : tasks_)
        if (pthread_equal(task->thread, thread) != 0) {
            waitFor(task);
            return;
        }
}

}  // namespace mfar::faults
