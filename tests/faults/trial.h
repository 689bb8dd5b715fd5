#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mfar::faults {

struct TrialOptions {
    std::filesystem::path program = MFAR_FAULTS_MFARD;
    int episodes = 10;
    std::string only;     ///< only kinds of faults whose names contain this text
    bool hasGpu = false;  ///< also use the GLES engine, with a library that can fail
    long soakFrames = 0;  ///< run this number of frames without faults; 0: run faults
    int job = 0;          ///< each job runs on its own processor if there are enough
};

struct TrialResult {
    /// The judge's report without sizes of memory, which do not depend on the program alone.
    std::string course;
    std::string failure;  ///< description for people; empty: mfard kept its promises
    std::map<std::string, long> counts;
};

/// Starts mfard in the surroundings of Board and waits until it ends. Throws std::system_error if
/// it cannot be started.
[[nodiscard]] TrialResult runTrial(const TrialOptions& options, std::uint64_t seed);

}  // namespace mfar::faults
