#pragma once

namespace mfar {

/// Lowers the calling thread's priority to SCHED_BATCH, and raises its nice value by 10 (to at most
/// 19). With SCHED_BATCH, a thread that wakes up does not preempt others. Returns false if the
/// system refuses either.
bool lowerThreadPriority();

/// Sets all threads of the process to nice 0 if the system permits it. To be called before the
/// process ends by force: each thread must run once more to end, so on a loaded machine, threads of
/// low priority delay the end of the process.
void raiseThreadPriorities() noexcept;

[[nodiscard]] double threadCpuMs();

}  // namespace mfar
