#include "base/thread_priority.h"

#include <pthread.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <sched.h>

namespace mfar {

bool lowerThreadPriority() {
    constexpr int kLower = 10, kLowest = 19;
    const sched_param none{};
    const auto thread = static_cast<id_t>(gettid());
    const bool batch = pthread_setschedparam(pthread_self(), SCHED_BATCH, &none) == 0;
    const int nice = std::min(getpriority(PRIO_PROCESS, thread) + kLower, kLowest);
    return setpriority(PRIO_PROCESS, thread, nice) == 0 && batch;
}

void raiseThreadPriorities() noexcept {
    std::error_code end;
    std::filesystem::directory_iterator task("/proc/self/task", end);
    for (; !end && task != std::filesystem::directory_iterator(); task.increment(end)) {
        const int thread = std::atoi(task->path().filename().c_str());
        (void)setpriority(PRIO_PROCESS, static_cast<id_t>(thread), 0);
    }
}

double threadCpuMs() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

}  // namespace mfar
