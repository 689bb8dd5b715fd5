#include "pipeline/epipolar/epipolar_search.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace mfar {
namespace {

using test::errorsOf;
using test::FlowErrors;
using test::landing;
using test::motion;
using test::Scene;
using test::Surface;
using test::View;

CameraModel plain() {
    return {{200, 150}, 190, 190, 99.5, 74.5, {}};
}

CameraModel barrel() {
    return {{200, 150}, 160, 161, 103, 72, {-0.29, 0.08, 0.001, -0.0012, 0.002}};
}

Scene flatScene() {
    return {{{{0, 0, 1}, 2}}, 30, 100};
}

Scene slantedScene() {
    return {{{Eigen::Vector3d(0.35, 0.2, 1).normalized(), 2}}, 30, 100};
}

Scene stepScene() {
    return {{{{0, 0, 1}, 3}, {{0, 0, 1}, 2, {-0.35, -0.4}, {0.45, 0.3}}}, 28, 100};
}

EpipolarSearch searched(const View& view, int threads = 2) {
    EpipolarSearch search = test::searchWith(view.camera, threads);
    search.setStill(test::viewOf(view.still()));
    EXPECT_TRUE(search.run(view.video(), view.T_still_video));
    EXPECT_TRUE(test::isFinite(search));
    return search;
}

// Upper limits of the median error [px] for oblique epipolar lines, and for lines along an axis of
// the picture. The still pixel nearest to a point on the line gives the point's cost. The offset of
// this pixel from the point has a component along the line, which the search corrects, and one
// across the line, which it does not correct. So oblique lines have larger errors.
constexpr double kAcross = 0.38, kAlongAxis = 0.22;

void expectErrors(const View& view, double median, double bad) {
    const FlowErrors errors = errorsOf(searched(view), view);
    EXPECT_GT(errors.pixels, 4000U);
    EXPECT_LT(errors.median, median);
    EXPECT_LT(errors.bad, bad);
    testing::Test::RecordProperty("median", std::to_string(errors.median));
    testing::Test::RecordProperty("bad", std::to_string(errors.bad));
}

TEST(EpipolarSearch, FindsAWallAfterASidewaysMotion) {
    for (const double t : {-0.25, -0.02, 0.05, 0.2})
        expectErrors({plain(), flatScene(), motion({0, 0, 0}, {t, 0, 0})}, kAlongAxis, 0.02);
    expectErrors({plain(), flatScene(), motion({0, 0, 0}, {0, 0.15, 0})}, kAlongAxis, 0.02);
}

// Here two consecutive labels (candidates on the line) have the same nearest pixel, and the pixels
// before and after it match equally well. So the true position is between these two labels.
TEST(EpipolarSearch, FindsAWallAtHalfPixelsAlongADiagonal) {
    const CameraModel camera = plain();
    for (const double pixels : {5.4, 5.5, 5.6, -8.5}) {
        const double t = 2 * pixels / camera.fx;
        expectErrors({camera, flatScene(), motion({0, 0, 0}, {t, t, 0})}, kAcross, 0.02);
        expectErrors({camera, flatScene(), motion({0, 0, 0}, {-t, t, 0})}, kAcross, 0.02);
    }
}

TEST(EpipolarSearch, FindsASlantedWall) {
    expectErrors({plain(), slantedScene(), motion({0, 0, 0}, {-0.2, 0, 0})}, kAlongAxis, 0.02);
    expectErrors({plain(), slantedScene(), motion({0, 0, 0}, {-0.2, 0.05, 0})}, kAcross, 0.02);
    expectErrors({plain(), slantedScene(), motion({0, 0, 0}, {0.1, -0.1, 0.02})}, kAcross, 0.02);
}

TEST(EpipolarSearch, FindsADepthStep) {
    expectErrors({plain(), stepScene(), motion({0, 0, 0}, {-0.2, 0, 0})}, kAlongAxis, 0.04);
    expectErrors({plain(), stepScene(), motion({0, 0, 0}, {0.1, 0.15, 0})}, kAcross, 0.04);
}

TEST(EpipolarSearch, FindsInverseDepth) {
    const View view{plain(), stepScene(), motion({0, 0, 0}, {-0.3, 0, 0})};
    const EpipolarSearch search = searched(view);
    const auto depthAt = [&](int x, int y) {
        return 1 / search.s()[static_cast<std::size_t>(y) * 200 + x];
    };
    EXPECT_NEAR(depthAt(105, 70), 2, 0.05);
    EXPECT_NEAR(depthAt(170, 20), 3, 0.1);
}

// The epipole is inside the picture, so that displacements are longest at the border.
TEST(EpipolarSearch, FindsScenesAfterAForwardMotion) {
    for (const double t : {-0.4, 0.4}) {
        expectErrors({plain(), stepScene(), motion({0, 0, 0}, {0, 0, t})}, 0.15, 0.04);
        expectErrors({plain(), slantedScene(), motion({0, 0, 0}, {0.03, 0.02, t})}, 0.15, 0.03);
    }
}

TEST(EpipolarSearch, FindsScenesAfterARotationInSpiteOfLensDistortion) {
    expectErrors({barrel(), slantedScene(), motion({4, -6, 8}, {-0.15, 0.1, 0.05})}, 0.2, 0.03);
    expectErrors({barrel(), stepScene(), motion({-3, 9, -25}, {0.2, 0.05, -0.2})}, 0.2, 0.06);
    expectErrors({barrel(), flatScene(), motion({0, 0, 90}, {0.1, 0.1, 0})}, 0.2, 0.03);
    expectErrors({barrel(), flatScene(), motion({2, -28, 5}, {0.15, 0, 0.1})}, 0.2, 0.04);
}

// The displacement needs three pyramid levels and is longer than the window of the coarsest level.
TEST(EpipolarSearch, FindsLongDisplacementsThroughThreePyramidLevels) {
    const CameraModel camera{{320, 240}, 300, 300, 159.5, 119.5, {}};
    const Scene scene{{{{0, 0, 1}, 3}, {{0, 0, 1}, 1.5, {-0.3, -0.3}, {0.3, 0.3}}}, 35, 100};
    expectErrors({camera, scene, motion({0, 0, 0}, {-0.5, 0, 0})}, 0.15, 0.05);
}

TEST(EpipolarSearch, FindsAVeryDistantScene) {
    const View view{plain(), {{{{0, 0, 1}, 1e5}}, 6e-4, 100}, motion({0, 3, 0}, {0.2, 0, 0})};
    const EpipolarSearch search = searched(view);
    const FlowErrors errors = errorsOf(search, view);
    EXPECT_LT(errors.median, 0.15);
    EXPECT_LT(errors.bad, 0.01);
}

TEST(EpipolarSearch, PureRotationNeedsNoSearch) {
    for (const CameraModel& camera : {plain(), barrel()}) {
        for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, -9, 12)}) {
            const EpipolarSearch search = searched({camera, stepScene(), motion(turn, {0, 0, 0})});
            EXPECT_EQ(search.labels(), 0);
            EXPECT_EQ(search.pixelsPerUnit(), 0);
            for (const float s : search.s())
                ASSERT_EQ(s, 0);
        }
    }
}

// pixelsPerUnit() is the motion [px] of the fastest pixel if s changes by 1.
TEST(EpipolarSearch, PixelsPerUnitIsTheLongestMotionOfAPixel) {
    for (const Eigen::Vector3d& t :
         {Eigen::Vector3d(0.2, 0, 0), Eigen::Vector3d(0.1, -0.1, 0.3), Eigen::Vector3d(0, 0, -1)}) {
        const EpipolarSearch search = searched({plain(), flatScene(), motion({0, 0, 0}, t)});
        double longest = 0;
        for (int y = 0; y < 150; ++y) {
            for (int x = 0; x < 200; ++x) {
                const Eigen::Vector2d r = plain().unproject({x, y});
                longest = std::max(longest, 190 * (t.head<2>() - r * t.z()).norm());
            }
        }
        EXPECT_NEAR(search.pixelsPerUnit(), longest, 2e-3 * longest);
    }
}

TEST(EpipolarSearch, IsInvariantToTheUnitOfLength) {
    const Eigen::Vector3d t(-0.15, 0.1, 0.05);
    View view{barrel(), stepScene(), motion({2, -3, 4}, t)};
    const LumaImage video = view.video(), still = view.still();
    const EpipolarSearch metres = searched(view);
    for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) {
        EpipolarSearch search = test::searchWith(view.camera, 2);
        search.setStill(test::viewOf(still));
        view.T_still_video.translation = unit * t;
        ASSERT_TRUE(search.run(video, view.T_still_video));
        EXPECT_EQ(search.labels(), metres.labels());
        EXPECT_NEAR(search.pixelsPerUnit(), unit * metres.pixelsPerUnit(),
                    1e-3 * unit * metres.pixelsPerUnit());
        // Steps along the line are in single precision. So rounding may change a few pixels.
        int apart = 0;
        for (int y = 0; y < 150; ++y)
            for (int x = 0; x < 200; ++x)
                apart += (landing(search, view, x, y) - landing(metres, view, x, y)).norm() > 0.1;
        EXPECT_LT(apart, 200 * 150 / 200) << unit;
    }
}

LumaImage developed(LumaImage picture, const std::function<double(double)>& curve) {
    for (std::uint8_t& p : picture.pixels)
        p = static_cast<std::uint8_t>(std::lround(std::clamp(curve(p), 0.0, 255.0)));
    return picture;
}

TEST(EpipolarSearch, SearchFromAPredictionIsAsGoodAsCoarseToFine) {
    const View view{plain(), stepScene(), motion({0, 2, 0}, {-0.2, 0.03, 0})};
    const EpipolarSearch whole = searched(view);
    const EpipolarLens cells(view.camera, 2);
    std::mt19937 random(6);
    std::normal_distribution<float> noise(0, static_cast<float>(1.5 / whole.pixelsPerUnit()));
    std::vector<float> predicted;
    for (std::size_t i = 0; i < static_cast<std::size_t>(cells.size().width) * cells.size().height;
         ++i) {
        const double z = view.scene.depth({}, {cells.rayX(i), cells.rayY(i)});
        predicted.push_back(static_cast<float>(1 / (z + whole.translation().z())) + noise(random));
    }
    EpipolarSearch search = test::searchWith(view.camera, 2);
    search.setStill(test::viewOf(view.still()));
    ASSERT_TRUE(search.run(view.video(), view.T_still_video, {}, predicted));
    const FlowErrors around = errorsOf(search, view), from = errorsOf(whole, view);
    EXPECT_LT(around.median, 1.05 * from.median);
    EXPECT_LT(around.bad, from.bad + 0.005);
    // Only values around the prediction are searched. So a wrong prediction must give a wrong
    // result.
    const auto far = static_cast<float>(30 / whole.pixelsPerUnit());
    for (float& s : predicted)
        s += far;
    ASSERT_TRUE(search.run(view.video(), view.T_still_video, {}, predicted));
    EXPECT_GT(errorsOf(search, view).bad, 0.9);
}

/// Share of the pixels in which both searches find the same surface. Exact values differ, because
/// the steps along the lines differ.
double alikeIn(const PixelRect& area, const EpipolarSearch& part, const EpipolarSearch& whole) {
    const PixelRect& from = part.area();
    int alike = 0, all = 0;
    for (int y = area.y0; y < area.y1; ++y) {
        for (int x = area.x0; x < area.x1; ++x, ++all) {
            const auto i =
                static_cast<std::size_t>(y - from.y0) * (from.x1 - from.x0) + x - from.x0;
            const auto j = static_cast<std::size_t>(y) * 200 + x;
            if (std::abs(part.s()[i] - whole.s()[j]) < 1 / whole.pixelsPerUnit()) ++alike;
        }
    }
    return static_cast<double>(alike) / all;
}

TEST(EpipolarSearch, ASearchOfAPartFindsTheSurfacesThatASearchOfTheWholeFinds) {
    const View view{barrel(), stepScene(), motion({1, -2, 3}, {-0.15, 0.1, 0.03})};
    const EpipolarSearch whole = searched(view);
    EpipolarSearch search = test::searchWith(view.camera, 2);
    search.setStill(test::viewOf(view.still()));
    for (const PixelRect& wanted :
         {PixelRect{61, 43, 139, 107}, PixelRect{0, 0, 70, 60}, PixelRect{123, 77, 200, 150}}) {
        search.setArea(wanted);
        EXPECT_EQ(around(search.area(), wanted), search.area());
        ASSERT_TRUE(search.run(view.video(), view.T_still_video));
        EXPECT_GT(alikeIn(wanted, search, whole), 0.93);
    }
    search.setArea({0, 0, 200, 150});
    ASSERT_TRUE(search.run(view.video(), view.T_still_video));
    EXPECT_EQ(search.s(), whole.s());
}

TEST(EpipolarSearch, GainAndGammaLowerTheAccuracyOnlyALittle) {
    const View view{plain(), stepScene(), motion({0, 2, 0}, {-0.2, 0.03, 0})};
    const LumaImage video = view.video(), still = view.still();
    const double plainBad = errorsOf(searched(view), view).bad;
    const std::function<double(double)> curves[] = {
        [](double v) { return 0.6 * v; },
        [](double v) { return 40 + 0.7 * v; },
        [](double v) { return 255 * std::pow(v / 255, 0.6); },
        [](double v) { return 200 * std::pow(v / 255, 1.6); },
    };
    for (const auto& curve : curves) {
        EpipolarSearch search = test::searchWith(view.camera, 2);
        search.setStill(test::viewOf(developed(still, curve)));
        ASSERT_TRUE(search.run(video, view.T_still_video));
        EXPECT_LT(errorsOf(search, view).bad, plainBad + 0.01);
        EXPECT_LT(errorsOf(search, view).median, kAcross);
    }
}

TEST(EpipolarSearch, NoiseLowersTheAccuracyOnlyALittle) {
    const View view{plain(), slantedScene(), motion({0, 2, 0}, {-0.2, 0.03, 0})};
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0, 5);
    const auto grain = [&](double v) { return v + noise(random); };
    EpipolarSearch search = test::searchWith(view.camera, 2);
    search.setStill(test::viewOf(developed(view.still(), grain)));
    ASSERT_TRUE(search.run(developed(view.video(), grain), view.T_still_video));
    EXPECT_LT(errorsOf(search, view).bad, 0.05);
}

}  // namespace
}  // namespace mfar
