#include "tests/engine/gl_test.h"
#include "tests/engine/gles/levels.h"

namespace mfar {
namespace {

using Luma = GlTest;

// Tolerance: half a grey level, plus rounding errors of single precision.
constexpr double kRounding = 0.501;

void expectNear(const twin::Grey& gpu, const twin::Grey& twin, double tolerance) {
    ASSERT_EQ(gpu.size, twin.size);
    double worst = 0;
    for (std::size_t i = 0; i < gpu.values.size(); ++i)
        worst = std::max(worst, std::abs(gpu.values[i] - twin.values[i]));
    EXPECT_LE(worst, tolerance);
}

TEST_F(Luma, LumaOfTheVideoMatchesTheOracle) {
    for (const Size size : {Size{64, 48}, Size{101, 59}})
        for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Gray8}) {
            const TestPicture a = randomPicture(size, 1, format),
                              b = randomPicture(size, 2, format);
            const LevelPair pair(a, b);
            expectNear(pair.first(), twin::smoothed(twin::luma(a.view())), kRounding);
            expectNear(pair.second(), twin::smoothed(twin::luma(b.view())), kRounding);
        }
}

TEST_F(Luma, CoarserLevelsAreExactMeans) {
    const TestPicture a = randomPicture({213, 119}, 1), b = randomPicture({213, 119}, 2);
    const LevelPair pair(a, b);
    ASSERT_EQ(pair.pyramids.video().size(), 3U);
    for (int level = 1; level < 3; ++level) {
        expectNear(pair.first(level), twin::halved(pair.first(level - 1)), 0);
        expectNear(pair.second(level), twin::halved(pair.second(level - 1)), 0);
    }
}

}  // namespace
}  // namespace mfar
