#include "tests/device/pretended_counts.h"

/// For another library in the same program: what the program should have refused.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" void mfar_pretended_refusable(const char* camera, std::uint64_t* broken,
                                         std::uint64_t* badTimes) {
    const auto counts = mfar::pretended::RefusableCounts::get().of(camera);
    *broken = counts.broken;
    *badTimes = counts.badTimes;
}
