#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mfar::faults {

struct TrialOptions {
    std::filesystem::path program = MFAR_FAULTS_MFARD;
    int episodes = 10;
    std::string only;     ///< only kinds of faults whose names contain this
    bool hasGpu = false;  ///< the engine is gles, and its library can fail, too
    long soakFrames = 0;  ///< no faults, but this number of pictures; 0: faults
    int job = 0;          ///< number of this job, which selects its processor
};

struct TrialResult {
    std::string course;   ///< the judge's report without memory use, which varies
    std::string failure;  ///< in words; empty: mfard has kept its guarantees
    std::map<std::string, long> counts;
};

/// Starts mfard with the board of tests/faults and waits for its end. Throws std::system_error when
/// it cannot be started.
[[nodiscard]] TrialResult runTrial(const TrialOptions& options, std::uint64_t seed);

}  // namespace mfar::faults
