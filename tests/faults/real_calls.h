#pragma once

#include <poll.h>
#include <pthread.h>

#include <semaphore.h>
#include <time.h>

namespace mfar::faults {

struct RealCalls {
    int (*clock)(clockid_t, timespec*);
    long (*syscall)(long, ...);
    int (*poll)(pollfd*, nfds_t, int);
    int (*create)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    int (*join)(pthread_t, void**);
    int (*lock)(pthread_mutex_t*);
    int (*tryLock)(pthread_mutex_t*);
    int (*unlock)(pthread_mutex_t*);
    int (*condInit)(pthread_cond_t*, const pthread_condattr_t*);
    int (*once)(pthread_once_t*, void (*)());
    int (*tryRead)(pthread_rwlock_t*);
    int (*tryWrite)(pthread_rwlock_t*);
    int (*unlockShared)(pthread_rwlock_t*);
    int (*tryTake)(sem_t*);
    int (*post)(sem_t*);
    void (*exitNow)(int);
};

[[nodiscard]] const RealCalls& real();

}  // namespace mfar::faults
