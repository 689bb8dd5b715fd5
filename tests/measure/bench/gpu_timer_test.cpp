#include "tests/engine/gl_test.h"
#include "tests/measure/bench/gpu_timer.h"

namespace mfar::gpu {
namespace {

using GpuTimer = GlTest;

TEST_F(GpuTimer, ReportsAPlausibleTimeOrThatItIsUnavailable) {
    Timer timer;
    timer.start();
    glFinish();
    timer.stop();
    glFinish();
    const auto ms = timer.read();
    if (!timer.available()) {
        EXPECT_FALSE(ms.has_value());
    } else if (ms.has_value()) {
        EXPECT_GE(*ms, 0);
        EXPECT_LT(*ms, 10'000);
    }
}

}  // namespace
}  // namespace mfar::gpu
