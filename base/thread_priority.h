#pragma once

namespace mfar {

/// Lowers the calling thread's priority to SCHED_BATCH and nice +10. With SCHED_BATCH, a thread
/// that wakes up does not preempt others. Returns false if the system refuses either.
bool lowerThreadPriority();

[[nodiscard]] double threadCpuMs();

}  // namespace mfar
