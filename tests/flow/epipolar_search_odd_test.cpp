#include "pipeline/epipolar/epipolar_search.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace mfar {
namespace {

using test::motion;
using test::Scene;
using test::View;

CameraModel cameraOf(Size size) {
    const double f = 0.95 * std::max(size.width, size.height);
    return {size, f, f, 0.5 * (size.width - 1), 0.5 * (size.height - 1), {}};
}

CameraModel barrelOf(Size size) {
    CameraModel camera = cameraOf(size);
    camera.distortion = {-0.3, 0.09, 0.001, 0.002, 0};
    return camera;
}

Scene scene() {
    return {{{{0, 0, 1}, 3}, {{0, 0, 1}, 2, {-0.35, -0.4}, {0.45, 0.3}}}, 28, 100};
}

LumaImage wholePictureOf(Size size, const std::function<int(int, int)>& grey) {
    LumaImage out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.row(y)[x] = static_cast<std::uint8_t>(grey(x, y));
    return out;
}

void expectSane(const EpipolarSearch& search, Size size) {
    ASSERT_TRUE(test::isFinite(search));
    ASSERT_EQ(search.s().size(), static_cast<std::size_t>(size.width) * size.height);
    ASSERT_TRUE(std::isfinite(search.pixelsPerUnit()));
    for (const float s : search.s()) {
        ASSERT_GE(s * search.pixelsPerUnit(), -size.width);
        ASSERT_LE(s * search.pixelsPerUnit(), 2 * size.width + 32);
    }
}

const std::vector<Eigen::Vector3d>& translations() {
    static const std::vector<Eigen::Vector3d> all{
        {0.2, 0, 0}, {0, -0.2, 0}, {0, 0, 0.4}, {0, 0, -0.4}, {-0.1, 0.1, 0.2}};
    return all;
}

TEST(EpipolarSearchOdd, UniformAndExtremePicturesGiveFiniteInverseDepths) {
    const Size size{97, 71};
    std::mt19937 random(1);
    const std::function<int(int, int)> greys[] = {
        [](int, int) { return 0; },
        [](int, int) { return 255; },
        [](int x, int y) { return (x + y) % 2 * 255; },
        [](int x, int) { return x % 2 * 255; },
        [&](int, int) { return random() % 2 == 0 ? 0 : 255; },
        [&](int, int) { return static_cast<int>(random() % 256); },
    };
    for (const auto& video : greys) {
        for (const auto& still : greys) {
            EpipolarSearch search = test::searchWith(barrelOf(size), 2);
            search.setStill(test::viewOf(wholePictureOf(size, still)));
            for (const Eigen::Vector3d& t : translations()) {
                ASSERT_TRUE(search.run(wholePictureOf(size, video), motion({3, -5, 10}, t)));
                expectSane(search, size);
            }
        }
    }
}

TEST(EpipolarSearchOdd, UniformPicturesGiveANearlyUniformInverseDepth) {
    const Size size{97, 71};
    EpipolarSearch search = test::searchWith(cameraOf(size), 2);
    search.setStill(test::viewOf(wholePictureOf(size, [](int, int) { return 90; })));
    ASSERT_TRUE(search.run(wholePictureOf(size, [](int, int) { return 140; }),
                           motion({0, 0, 0}, {0.2, 0, 0})));
    const auto [least, greatest] = std::minmax_element(search.s().begin(), search.s().end());
    EXPECT_LT((*greatest - *least) * search.pixelsPerUnit(), 8);
}

TEST(EpipolarSearchOdd, PicturesOfTinyAndOddSizesGiveValidInverseDepths) {
    for (const Size size : {Size{16, 16}, Size{17, 16}, Size{61, 45}, Size{45, 61}, Size{16, 100},
                            Size{100, 16}, Size{121, 119}}) {
        for (const CameraModel& camera : {cameraOf(size), barrelOf(size)}) {
            const LumaImage picture = scene().render(camera, {});
            EpipolarSearch search = test::searchWith(camera, 3);
            search.setStill(test::viewOf(picture));
            for (const Eigen::Vector3d& t : translations()) {
                ASSERT_TRUE(search.run(picture, motion({1, 2, 3}, t)))
                    << size.width << 'x' << size.height;
                expectSane(search, size);
            }
        }
    }
}

TEST(EpipolarSearchOdd, SmallPicturesAreMatched) {
    const CameraModel camera = cameraOf({61, 45});
    const View view{camera, {{{{0, 0, 1}, 2}}, 9, 100}, motion({0, 0, 0}, {0.2, 0, 0})};
    EpipolarSearch search = test::searchWith(camera, 2);
    search.setStill(test::viewOf(view.still()));
    ASSERT_TRUE(search.run(view.video(), view.T_still_video));
    const auto errors = errorsOf(search, view);
    EXPECT_LT(errors.median, 0.2);
    EXPECT_LT(errors.bad, 0.03);
}

TEST(EpipolarSearchOdd, PosesWithoutOverlapAreRefused) {
    for (const CameraModel& camera : {cameraOf({120, 90}), barrelOf({120, 90})}) {
        const LumaImage picture = scene().render(camera, {});
        EpipolarSearch search = test::searchWith(camera, 2);
        search.setStill(test::viewOf(picture));
        ASSERT_TRUE(search.run(picture, motion({0, 0, 0}, {0.2, 0, 0})));
        for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 180, 0), Eigen::Vector3d(180, 0, 0),
                                            Eigen::Vector3d(0, 140, 30)}) {
            EXPECT_FALSE(search.run(picture, motion(turn, {0.2, 0, 0})));
            EXPECT_EQ(search.labels(), 0);
        }
        EXPECT_TRUE(search.run(picture, motion({0, 0, 180}, {0.2, 0, 0})));
        expectSane(search, camera.size);
    }
}

TEST(EpipolarSearchOdd, EveryRotationGivesAFiniteResultOrIsRefused) {
    const CameraModel camera = barrelOf({120, 90});
    const LumaImage picture = scene().render(camera, {});
    EpipolarSearch search = test::searchWith(camera, 2);
    search.setStill(test::viewOf(picture));
    std::mt19937 random(6);
    std::uniform_real_distribution<double> degrees(-180, 180), metres(-1, 1);
    int searched = 0;
    for (int i = 0; i < 60; ++i) {
        const Eigen::Vector3d turn(degrees(random) / 4, degrees(random) / 2, degrees(random));
        const Eigen::Vector3d t(metres(random), metres(random), metres(random));
        if (!search.run(picture, motion(turn, t))) continue;
        ++searched;
        expectSane(search, camera.size);
    }
    EXPECT_GT(searched, 10);
}

TEST(EpipolarSearchOdd, NonFinitePosesAreRefusedOrGiveNoParallax) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const CameraModel camera = cameraOf({120, 90});
    const LumaImage picture = scene().render(camera, {});
    EpipolarSearch search = test::searchWith(camera, 2);
    search.setStill(test::viewOf(picture));
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        if (search.run(picture, motion({1, 2, 3}, {bad, 0, 0}))) {
            EXPECT_EQ(search.labels(), 0);
            expectSane(search, camera.size);
        }
        EXPECT_FALSE(search.run(picture, motion({0, bad, 0}, {0.1, 0, 0})));
    }
    EXPECT_TRUE(search.run(picture, motion({0, 0, 0}, {0.1, 0, 0})));
    expectSane(search, camera.size);
}

TEST(EpipolarSearchOdd, TheResultDoesNotDependOnTheNumberOfThreads) {
    const View view{barrelOf({180, 130}), scene(), motion({2, -4, 9}, {-0.2, 0.1, 0.1})};
    const LumaImage video = view.video(), still = view.still();
    std::vector<float> one;
    for (int threads = 1; threads <= 4; ++threads) {
        EpipolarSearch search = test::searchWith(view.camera, threads);
        search.setStill(test::viewOf(still));
        for (int again = 0; again < 3; ++again) {
            ASSERT_TRUE(search.run(video, view.T_still_video));
            if (one.empty()) one = search.s();
            ASSERT_EQ(search.s(), one) << threads << " threads";
        }
    }
}

TEST(EpipolarSearchOdd, TheResultDoesNotDependOnEarlierFrames) {
    const CameraModel camera = barrelOf({180, 130});
    const LumaImage video = scene().render(camera, {}),
                    other = scene().render(camera, motion({9, 9, 9}, {0, 0, 1}));
    const RigidTransform pose = motion({2, -4, 9}, {-0.2, 0.1, 0.1});
    const LumaImage still = scene().render(camera, pose);
    EpipolarSearch fresh = test::searchWith(camera, 2), used = test::searchWith(camera, 2);
    fresh.setStill(test::viewOf(still));
    ASSERT_TRUE(fresh.run(video, pose));
    used.setStill(test::viewOf(other));
    (void)used.run(video, motion({10, 40, 80}, {1, 1, -1}));
    (void)used.run(other, motion({0, 180, 0}, {1, 1, -1}));
    (void)used.run(other, motion({0, 5, 0}, {0, 0, 0}));
    used.setStill(test::viewOf(still));
    ASSERT_TRUE(used.run(video, pose));
    EXPECT_EQ(used.s(), fresh.s());
    EXPECT_EQ(used.labels(), fresh.labels());
}

}  // namespace
}  // namespace mfar
