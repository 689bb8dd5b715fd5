#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mfar::faults {

struct TrialOptions {
    std::filesystem::path program = MFAR_FAULTS_MFARD;
    int episodes = 10;
    std::string only;  ///< text that the names of the faults must contain
    /// True: mfard uses the GLES engine instead of the SIMD engine, and faults of the GPU are
    /// added.
    bool hasGpu = false;
    long soakFrames = 0;  ///< number of frames of a run without faults; 0: the run has faults
    int job = 0;  ///< index of the process; each runs on its own processor if there are enough
};

struct TrialResult {
    /// The judge's report without sizes of memory, because these differ even between equal runs.
    std::string course;
    std::string failure;  ///< description for the user; empty if mfard violated no rule
    std::map<std::string, long> counts;
};

/// Starts mfard with Board as its environment and waits until it ends. Throws std::system_error if
/// mfard cannot be started.
[[nodiscard]] TrialResult runTrial(const TrialOptions& options, std::uint64_t seed);

}  // namespace mfar::faults
