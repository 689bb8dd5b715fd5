#pragma once

#include <cstdint>
#include <hwy/targets.h>

namespace mfar::test {

/// Calls body() once for each instruction set that this processor and this program both support.
template <class Body>
void onEveryTarget(const Body& body) {
    const std::int64_t all = hwy::SupportedTargets();
    for (std::int64_t left = all; left != 0; left &= left - 1) {
        const std::int64_t target = left & -left;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        body();
    }
    hwy::SetSupportedTargetsForTest(all);
    hwy::GetChosenTarget().Update(all);
}

}  // namespace mfar::test
