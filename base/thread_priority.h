#pragma once

namespace mfar {

/// Lowers the calling thread's priority: SCHED_BATCH, whose threads do not preempt waking threads,
/// and nice +10. False if the system refuses either.
bool lowerThreadPriority();

/// Processor time of the calling thread [ms].
[[nodiscard]] double threadCpuMs();

}  // namespace mfar
