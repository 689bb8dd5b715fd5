#include "tests/device/pretended_counts.h"

/// Tells another library in the same program about the use of `camera`: how many pictures the
/// program should have refused, the gain that it set, and how many pictures it took before that.
/// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" void mfar_pretended_known(const char* camera, std::uint64_t* broken,
                                     std::uint64_t* badTimes, std::int64_t* gain,
                                     std::uint64_t* ungained) {
    const auto known = mfar::pretended::Known::get().of(camera);
    *broken = known.broken;
    *badTimes = known.badTimes;
    *gain = known.gain;
    *ungained = known.ungained;
}
