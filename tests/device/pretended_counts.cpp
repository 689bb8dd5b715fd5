#include "tests/device/pretended_counts.h"

/// Reports to another library how the program used `camera`: the numbers of invalid pictures that
/// it took, the gain that it set, and the number of pictures that it took before it set the gain.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" void mfar_pretended_known(const char* camera, std::uint64_t* broken,
                                     std::uint64_t* badTimes, std::int64_t* gain,
                                     std::uint64_t* ungained) {
    const auto known = mfar::pretended::Known::get().of(camera);
    *broken = known.broken;
    *badTimes = known.badTimes;
    *gain = known.gain;
    *ungained = known.ungained;
}
