#pragma once

#include <functional>
#include <map>
#include <string>

namespace mfar::stress {

/// What came of a run.
struct Tally {
    std::map<std::string, long> pixels;  ///< through each pass
    std::map<std::string, long> inputs;  ///< of the parts that have no pixels
    long cases = 0, seeds = 0, failures = 0;
};

/// Calls `work` with 0, 1, ... in as many processes of their own and adds up what they give. One
/// that crashes is a failure and is told. After a failure the others are ended, unless `keepGoing`.
/// Before the first thread and graphics context. Throws std::runtime_error.
[[nodiscard]] Tally inProcesses(int count, bool keepGoing, const std::function<Tally(int)>& work);

}  // namespace mfar::stress
