#include "base/thread_priority.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <sched.h>

namespace mfar {

bool lowerThreadPriority() {
    constexpr int kNice = 10;
    const sched_param none{};
    const bool batch = pthread_setschedparam(pthread_self(), SCHED_BATCH, &none) == 0;
    return setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice) == 0 && batch;
}

double threadCpuMs() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

}  // namespace mfar
