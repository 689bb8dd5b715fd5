#include "tests/engine/gl_test.h"
#include "tests/measure/bench/gpu_timer.h"

#include <chrono>
#include <optional>
#include <thread>

namespace mfar::gpu {
namespace {

using GpuTimer = GlTest;

TEST_F(GpuTimer, ReportsAPlausibleTimeIfAvailable) {
    Timer timer;
    timer.start();
    glFinish();
    timer.stop();
    glFinish();
    std::optional<double> ms = timer.read();
    if (!timer.available()) {
        EXPECT_FALSE(ms.has_value());
        return;
    }
    // The result may be late. It is missing if the GPU has changed its clock, so the measurement is
    // repeated.
    for (int i = 0; !ms && i < 100; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        if (i % 10 == 9) {
            timer.start();
            glFinish();
            timer.stop();
            glFinish();
        }
        ms = timer.read();
    }
    ASSERT_TRUE(ms.has_value());
    EXPECT_GE(*ms, 0);
    EXPECT_LT(*ms, 10'000);
}

}  // namespace
}  // namespace mfar::gpu
