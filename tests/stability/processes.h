#pragma once

#include <functional>
#include <map>
#include <string>

namespace mfar::stress {

/// Counts of a run.
struct Tally {
    std::map<std::string, long> pixels;  ///< of each pass
    std::map<std::string, long> inputs;  ///< of the parts that do not process pictures
    long cases = 0, seeds = 0, failures = 0;
};

/// Calls `work` with 0, 1, ... in `count` processes and adds up the results. A process that crashes
/// counts as a failure and is reported. After a failure the others are ended, unless `keepGoing`.
/// Must be called before the first thread and graphics context are created. Throws
/// std::runtime_error.
[[nodiscard]] Tally inProcesses(int count, bool keepGoing, const std::function<Tally(int)>& work);

}  // namespace mfar::stress
