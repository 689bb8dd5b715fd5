#pragma once

namespace mfar {

/// Gives the calling thread less of the processor than others have: SCHED_BATCH, whose threads do
/// not interrupt any that wake up, and nice +10. False if the system refuses either.
bool lowerThreadPriority();

/// Processor time of the calling thread [ms].
[[nodiscard]] double threadCpuMs();

}  // namespace mfar
