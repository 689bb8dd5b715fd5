// Programs that link this file run the SIMD kernels on the baseline target of this build. On x86 it
// is Highway's scalar target with Highway 1.0, SSE2 with later versions; on ARM it is NEON.
#include <hwy/targets.h>

namespace {

// Highway runs the baseline if HWY_SCALAR is the only supported target.
[[maybe_unused]] const bool kChosen = [] {
    hwy::SetSupportedTargetsForTest(HWY_SCALAR);
    hwy::GetChosenTarget().Update(HWY_SCALAR);
    return true;
}();

}  // namespace
