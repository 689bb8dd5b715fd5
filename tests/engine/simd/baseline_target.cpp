// Linked into tests that run the SIMD kernels on the baseline of this build: Highway's scalar
// target with version 1.0 on x86, SSE2 with later versions, NEON on ARM.
#include <hwy/targets.h>

namespace {

// Highway runs the baseline if HWY_SCALAR is the only supported target.
[[maybe_unused]] const bool kChosen = [] {
    hwy::SetSupportedTargetsForTest(HWY_SCALAR);
    hwy::GetChosenTarget().Update(HWY_SCALAR);
    return true;
}();

}  // namespace
