#include "pipeline/epipolar/unit_pose.h"
#include "pipeline/plan/camera_rest.h"
#include "pipeline/plan/work_plan.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mfar {
namespace {

constexpr double kStructure = 100;

Timestamp frameTime(int frame) {
    return Timestamp::fromSeconds(1 + frame / 30.0);
}

/// Tiles with structure, of which the first `changed` have changed.
std::vector<TileMeasure> tilesWith(int changed) {
    std::vector<TileMeasure> out(100);
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].structure = 2 * kStructure;
        out[i].changed = static_cast<int>(i) < changed;
    }
    return out;
}

TEST(CameraRest, APersonInFrontOfARestingCameraDoesNotCountAsMotion) {
    CameraRest rest;
    rest.add(tilesWith(100), kStructure, 0, frameTime(0));
    for (int i = 1; i < 200; ++i)
        rest.add(tilesWith(20), kStructure, 0, frameTime(i));
    EXPECT_FALSE(rest.restedSince(frameTime(0)));
    EXPECT_TRUE(rest.restedSince(frameTime(1)));
    rest.add(tilesWith(30), kStructure, 0, frameTime(200));
    EXPECT_FALSE(rest.restedSince(frameTime(200)));
    rest.add(tilesWith(0), kStructure, 0, frameTime(202));
    EXPECT_TRUE(rest.restedSince(frameTime(201)));
    EXPECT_FALSE(rest.restedSince(frameTime(203))) << "no frame of this time or later was added";
}

TEST(CameraRest, TilesThatChangeOneAfterTheOtherShowASlowMotion) {
    CameraRest rest;
    rest.add(tilesWith(0), kStructure, 0, frameTime(0));
    for (int i = 1; i <= 30; ++i) {
        std::vector<TileMeasure> tiles = tilesWith(0);
        tiles[static_cast<std::size_t>(i)].changed = true;
        rest.add(tiles, kStructure, 0, frameTime(i));
    }
    EXPECT_FALSE(rest.restedSince(frameTime(1)));
}

TEST(CameraRest, TwoNewStillsPerSecondDoNotCountAsMotionAtAnyFrameRate) {
    for (const int rate : {5, 10, 30, 120}) {
        CameraRest rest;
        const auto timeOf = [&](int i) { return Timestamp::fromSeconds(1 + double(i) / rate); };
        for (int i = 0; i < 20 * rate; ++i)
            rest.add(tilesWith(0), kStructure, i % (rate / 2) == 0 ? 1 : 0, timeOf(i));
        EXPECT_TRUE(rest.restedSince(timeOf(1))) << rate;
        for (int i = 20 * rate; i < 22 * rate; ++i)
            rest.add(tilesWith(0), kStructure, 1, timeOf(i));
        EXPECT_FALSE(rest.restedSince(timeOf(1))) << rate << ": every frame is drawn as a whole";
    }
}

TEST(CameraRest, WithoutStructureNothingShowsThatTheCameraRests) {
    CameraRest rest;
    std::vector<TileMeasure> tiles = tilesWith(0);
    for (std::size_t i = 5; i < tiles.size(); ++i)
        tiles[i].structure = 0;
    rest.add(tiles, kStructure, 0, frameTime(0));
    rest.add(tiles, kStructure, 0, frameTime(1));
    EXPECT_FALSE(rest.restedSince(frameTime(1)));
}

test::Scene panels() {
    return {{{Eigen::Vector3d(0.2, 0.1, 1).normalized(), 1.6},
             {{0, 0, 1}, 1, {-0.2, -0.15}, {0.25, 0.2}}},
            50,
            100};
}

CameraModel videoCamera() {
    return {{240, 180}, 200, 201, 122, 88, {}};
}

RgbPlanes noisy(const LumaImage& light, double sigma, std::mt19937& random) {
    std::normal_distribution<double> noise(0, sigma);
    std::vector<std::uint8_t> bytes;
    for (int y = 0; y < light.size.height; ++y)
        for (int x = 0; x < light.size.width; ++x)
            bytes.push_back(static_cast<std::uint8_t>(
                std::clamp(std::lround(light.rows()[y][x] + noise(random)), 0L, 255L)));
    RgbPlanes out(light.size);
    out.take(
        {bytes.data(), light.size, static_cast<std::size_t>(light.size.width), PixelFormat::Gray8});
    return out;
}

/// Plans frames of a camera that moves sideways by `step` [m] per frame. Returns the number of the
/// first frame at which CameraRest notices the motion, or `frames` if it never does. `sigma`:
/// standard deviation of the noise [grey levels]. `drawsAll`: every frame is drawn as a whole.
int framesAtRest(double step, double sigma, int frames, bool drawsAll = false) {
    std::mt19937 random(7);
    WorkPlan plan(videoCamera().size);
    CameraRest rest;
    RgbPlanes drawn(videoCamera().size);
    for (int i = 0; i < frames; ++i) {
        const RigidTransform T_camera_start = test::motion({0, 0, 0}, {step * i, 0, 0});
        const RgbPlanes now = noisy(panels().render(videoCamera(), T_camera_start), sigma, random);
        plan.update(now, drawn, i == 0 || drawsAll);
        rest.add(plan.measured(), plan.leastStructure(), plan.redrawnShare() - plan.changedShare(),
                 frameTime(i));
        if (i > 0 && !rest.restedSince(frameTime(1))) return i;
        for (int t = 0; t < static_cast<int>(plan.work().flags.size()); ++t)
            if (plan.work().flags[static_cast<std::size_t>(t)].changed != 0)
                drawn.takeTile(now, t % plan.tileCount().width, t / plan.tileCount().width);
    }
    return frames;
}

TEST(CameraRest, NoiseDoesNotCountAsMotion) {
    for (const double sigma : {0.5, 2.0})
        EXPECT_EQ(framesAtRest(0, sigma, 60), 60) << sigma;
}

TEST(CameraRest, AMotionOfHalfAPixelIsNoticed) {
    // The wall is 1.6 m away, so it moves by 125 px per metre of camera motion.
    for (const double pixelsPerFrame : {0.02, 0.1, 0.5})
        for (const double sigma : {0.5, 2.0})
            EXPECT_LT(framesAtRest(pixelsPerFrame / 125, sigma, 100) * pixelsPerFrame, 0.6)
                << pixelsPerFrame << " px per frame, noise " << sigma;
}

TEST(CameraRest, ASlowMotionIsNoticedAlsoIfEveryFrameIsDrawn) {
    EXPECT_LT(framesAtRest(0.1 / 125, 1, 100, true), 12);
}

TEST(CameraRest, TilesDrawnForNewStillsDoNotCountAsMotion) {
    CameraRest rest;
    for (int i = 0; i < 300; ++i)
        rest.add(tilesWith(0), kStructure, i % 15 == 0 ? 1 : 0, frameTime(i));
    EXPECT_TRUE(rest.restedSince(frameTime(1)));
}

/// A pose with standard deviations of 0.1 degrees and 3 mm.
Pose trackedAt(const RigidTransform& T_world_video) {
    Pose out{frameTime(0), T_world_video};
    out.covariance.diagonal() << Eigen::Vector3d::Constant(std::pow(0.1 * M_PI / 180, 2)),
        Eigen::Vector3d::Constant(9e-6);
    return out;
}

TEST(RestingPose, ErrorsOfThePosesDoNotMatterAtRest) {
    const RigidTransform T_still_video = test::motion({0, 1, 0}, {0.014, 0, 0});
    const Pose still = trackedAt(test::motion({10, 20, 30}, {1, 2, 3}));
    const Pose frame =
        trackedAt(still.T_world_video * test::motion({0.1, -0.1, 0}, {0.004, -0.002, 0.001}));
    EXPECT_GT(unitPose(T_still_video, still, frame).lengthError, 0.2);
    const UnitPose relative = restingPose(T_still_video, still, frame);
    EXPECT_NEAR(relative.unit, 0.014, 1e-9);
    EXPECT_LT(relative.lengthError, 0.02);
    EXPECT_NEAR(relative.T_other_frame.translation.x(), 1, 1e-9);
}

TEST(RestingPose, PosesThatAreSurelyApartAreUsed) {
    const RigidTransform T_still_video = test::motion({0, 1, 0}, {0.014, 0, 0});
    const Pose still = trackedAt({});
    const Pose frame = trackedAt(test::motion({0, 0, 0}, {0.05, 0, 0}));
    EXPECT_EQ(restingPose(T_still_video, still, frame).unit,
              unitPose(T_still_video, still, frame).unit);
    EXPECT_EQ(restingPose({}, still, frame).unit, unitPose({}, still, frame).unit);
    Pose exact;
    exact.T_world_video = frame.T_world_video;
    EXPECT_EQ(restingPose({}, {}, exact).unit, unitPose({}, {}, exact).unit);
}

}  // namespace
}  // namespace mfar
