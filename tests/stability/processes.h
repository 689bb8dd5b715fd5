#pragma once

#include <functional>
#include <map>
#include <string>

namespace mfar::stress {

struct Tally {
    std::map<std::string, long> pixels;
    std::map<std::string, long> inputs;  ///< inputs of each part that does not process pictures
    long cases = 0, seeds = 0, failures = 0;
};

/// Calls `work` with 0, 1, ... in `count` processes and adds up the results. A crash of a process
/// is a failure and is reported. After a failure the other processes are ended, unless `keepGoing`
/// is true. Must be called before any thread or graphics context is created. Throws
/// std::system_error if a system call fails.
[[nodiscard]] Tally inProcesses(int count, bool keepGoing, const std::function<Tally(int)>& work);

}  // namespace mfar::stress
