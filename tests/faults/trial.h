#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mfar::faults {

struct TrialOptions {
    std::filesystem::path program = MFAR_FAULTS_MFARD;
    int episodes = 10;
    std::string only;     ///< kinds of faults, by a part of their names
    bool hasGpu = false;  ///< the engine is gles, and its library can fail as well
    long soakFrames = 0;  ///< no faults, but so many pictures; 0: faults
    int job = 0;          ///< each has a processor of its own, as far as there are
};

struct TrialResult {
    std::string course;   ///< the judge's report, without what is not the program's: memory
    std::string failure;  ///< for people; empty: mfard has kept its promises
    std::map<std::string, long> counts;
};

/// Starts mfard with the board of tests/faults and waits for its end. Throws std::system_error
/// where it cannot be started.
[[nodiscard]] TrialResult runTrial(const TrialOptions& options, std::uint64_t seed);

}  // namespace mfar::faults
