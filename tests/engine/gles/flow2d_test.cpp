#include "pipeline/pipeline.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

using Flow = GlTest;
using Eigen::Vector2d;

constexpr Size kSmall{160, 120};

struct Errors {
    double mean = 0, worst = 0;
    Vector2d bias{0, 0};
};

/// Errors relative to a constant flow. Counts only pixels that, like their targets, are at least
/// `border` px inside the picture.
Errors errorsOf(const std::vector<float>& flow, Size size, const Vector2d& truth, int border) {
    Errors e;
    int n = 0;
    const Size last{size.width - 1 - border, size.height - 1 - border};
    for (int y = border; y <= last.height; ++y)
        for (int x = border; x <= last.width; ++x) {
            const Vector2d goal = Vector2d(x, y) + truth;
            if (goal.x() < border || goal.y() < border) continue;
            if (goal.x() > last.width || goal.y() > last.height) continue;
            const std::size_t i = 2UL * (1UL * y * size.width + x);
            const Vector2d d = Vector2d(flow[i], flow[i + 1]) - truth;
            e.mean += d.norm();
            e.bias += d;
            e.worst = std::max(e.worst, d.norm());
            ++n;
        }
    e.mean /= n;
    e.bias /= n;
    return e;
}

Errors shiftErrors(const Waves& waves, Size size, const Vector2d& truth, int border,
                   double gain = 1, double offset = 0) {
    const TestPicture a = waves.shoot(size, {});
    const TestPicture b = waves.shoot(size, {.shift = -truth, .gain = gain, .offset = offset});
    return errorsOf(flowBetween(a.view(), b.view()), size, truth, border);
}

TEST_F(Flow, ShiftsAreFound) {
    const Waves waves(1, 8, 80, 35);
    for (const Vector2d& shift :
         std::vector<Vector2d>{Vector2d(0, 0), Vector2d(1, 0), Vector2d(-3, 2), Vector2d(7, -5),
                               Vector2d(0.5, 0.25), Vector2d(-1.3, 0.7), Vector2d(4.6, 3.1)}) {
        const Errors e = shiftErrors(waves, kSmall, shift, 12);
        EXPECT_LT(e.mean, 0.05) << shift.transpose();
        EXPECT_LT(e.worst, 0.3) << shift.transpose();
    }
}

TEST_F(Flow, LargeMotionIsFound) {
    const Errors e = shiftErrors(Waves(2, 8, 200, 35), {640, 480}, {60, -12}, 24);
    EXPECT_LT(e.mean, 0.1);
}

TEST_F(Flow, TinyMotionIsFound) {
    const Errors e = shiftErrors(Waves(3, 8, 80, 35), kSmall, {0.1, -0.1}, 12);
    EXPECT_LT(e.bias.norm(), 0.02);
    EXPECT_LT(e.mean, 0.05);
}

TEST_F(Flow, FlowDoesNotDependOnGainAndOffset) {
    const Errors e = shiftErrors(Waves(4, 8, 80, 30), kSmall, {2.4, -1.7}, 12, 0.7, 40);
    EXPECT_LT(e.mean, 0.05);
    EXPECT_LT(e.worst, 0.3);
}

TEST_F(Flow, FlowBetweenFlatPicturesIsZero) {
    for (const std::uint8_t level : {0, 128, 255}) {
        const TestPicture a(kSmall, PixelFormat::Rgba8, level), b(kSmall, PixelFormat::Rgba8, 77);
        for (const float v : flowBetween(a.view(), b.view())) {
            ASSERT_TRUE(std::isfinite(v));
            ASSERT_LE(std::abs(v), 1e-3F);
        }
    }
}

TEST_F(Flow, UnrelatedPicturesGiveBoundedFlow) {
    const TestPicture noise = randomPicture(kSmall, 1), other = randomPicture(kSmall, 2);
    for (const TestPicture& b : {other, checkerboard(kSmall), TestPicture(kSmall)})
        for (const float v : flowBetween(noise.view(), b.view())) {
            ASSERT_TRUE(std::isfinite(v));
            ASSERT_LE(std::abs(v), 2.0F * kSmall.width);
        }
}

TEST_F(Flow, FlowIsFoundInGreyPicturesOfSmallAndOddSizes) {
    for (const Size size : {Size{101, 59}, Size{16, 16}, Size{67, 53}}) {
        const Waves waves(5, 8, 60, 35);
        const TestPicture a = waves.shoot(size, {.format = PixelFormat::Gray8});
        const TestPicture b = waves.shoot(size, {.shift = {-1, 0.5}, .format = PixelFormat::Gray8});
        const Errors e = errorsOf(flowBetween(a.view(), b.view()), size, {1, -0.5}, 6);
        EXPECT_LT(e.mean, 0.2) << size.width << "x" << size.height;
    }
}

TEST_F(Flow, PicturesOfDifferentOrTooSmallSizesAreRefused) {
    const TestPicture a({64, 48}), b({64, 47}), tiny({15, 64});
    EXPECT_THROW(static_cast<void>(flowBetween(a.view(), b.view())), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(flowBetween(tiny.view(), tiny.view())), std::invalid_argument);
}

}  // namespace
}  // namespace mfar
