#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mfar::faults {

struct TrialOptions {
    std::filesystem::path program = MFAR_FAULTS_MFARD;
    int episodes = 10;
    std::string only;     ///< only faults whose kinds contain this text
    bool hasGpu = false;  ///< use the engine gles with a library that can fail, too
    long soakFrames = 0;  ///< number of frames without faults; 0: faults
    int job = 0;          ///< each job has its own processor, if there are enough
};

struct TrialResult {
    /// The judge's report without memory sizes, which do not depend on the program alone.
    std::string course;
    std::string failure;  ///< for users; empty: mfard has kept its promises
    std::map<std::string, long> counts;
};

/// Starts mfard in the surroundings of Board and waits for its end. Throws std::system_error if it
/// cannot be started.
[[nodiscard]] TrialResult runTrial(const TrialOptions& options, std::uint64_t seed);

}  // namespace mfar::faults
