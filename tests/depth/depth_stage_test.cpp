#include "pipeline/depth/depth_stage.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar {
namespace {

using test::motion;
using test::Scene;

constexpr double kFrame = 1.0 / 30;

CameraModel barrelCamera() {
    return {{240, 180}, 200, 201, 122, 88, {-0.25, 0.06, 0.001, -0.0012, 0.002}};
}

Scene panelScene() {
    return {{{Eigen::Vector3d(0.2, 0.1, 1).normalized(), 1.6},
             {{0, 0, 1}, 1, {-0.2, -0.15}, {0.25, 0.2}}},
            50,
            100};
}

/// Runs the depth stage while a camera moves in the scene. The scene is given in world coordinates.
class Walk {
public:
    explicit Walk(const DepthOptions& options = {}, const PixelRect& where = kAll)
        : stage_(barrelCamera(), std::make_shared<Workers>(2), options), where_(where) {}

    void go(const RigidTransform& T_world_video) {
        pose_ = T_world_video;
        stage_.run(scene_.render(barrelCamera(), T_world_video.inverse()), nextPose(), {}, where_);
    }
    /// Runs a frame with a still that is not used, because its baseline is not known well.
    void goBesideUnusableStill(const RigidTransform& T_world_video) {
        pose_ = T_world_video;
        const EpipolarSearch search = test::searchWith(barrelCamera(), 2);
        stage_.run(scene_.render(barrelCamera(), T_world_video.inverse()), nextPose(),
                   DepthStage::StillSearch{search, Eigen::Matrix3f::Identity(), 1, 0.5, {}},
                   where_);
    }
    /// Runs a frame at the last pose, with a still that a camera beside the video camera took.
    void rest() {
        const RigidTransform T_still_video = motion({0, 0, 0}, {0.06, 0.02, 0});
        EpipolarSearch search = test::searchWith(barrelCamera(), 2);
        search.setStill(scene_.render(barrelCamera(), T_still_video * pose_.inverse()));
        const LumaImage video = scene_.render(barrelCamera(), pose_.inverse());
        ASSERT_TRUE(search.run(video, T_still_video));
        const Eigen::Matrix3f R = Eigen::Matrix3f::Identity();
        stage_.run(video, nextPose(), DepthStage::StillSearch{search, R, 1, 0.01, {}}, where_);
    }
    void measureIn(const PixelRect& where) { where_ = where; }
    [[nodiscard]] int known(const PixelRect& where) const {
        int out = 0;
        for (int y = where.y0; y < where.y1; ++y)
            for (int x = where.x0; x < where.x1; ++x)
                out += stage_.field().isKnown(static_cast<std::size_t>(y) * kAll.x1 + x) ? 1 : 0;
        return out;
    }
    /// The poses of the next frames are in another world frame.
    void changeWorld() { ++world_; }
    void change(const Scene& scene) { scene_ = scene; }
    void goSideways(int frames, double step) {
        for (int i = 0; i < frames; ++i)
            go(at(x_ += step));
    }
    static RigidTransform at(double x) { return motion({0, 0, 0}, {x, 0.3 * x, 0}); }

    struct Errors {
        double median = 0;    ///< median of |z - truth| / truth over pixels with known depth
        double bad = 0;       ///< share of pixels with known depth whose error is above a tenth
        double complete = 0;  ///< share of pixels with known depth
    };
    [[nodiscard]] Errors errors() const {
        std::vector<double> all;
        std::size_t pixels = 0;
        const PixelRect scored = common(where_, {8, 8, kAll.x1 - 8, kAll.y1 - 8});
        for (int y = scored.y0; y < scored.y1; ++y) {
            for (int x = scored.x0; x < scored.x1; ++x, ++pixels) {
                const auto i = static_cast<std::size_t>(y) * kAll.x1 + x;
                const double z = scene_.depth(pose_.inverse(), barrelCamera().unproject({x, y}));
                if (stage_.field().isKnown(i))
                    all.push_back(
                        std::abs(1 / std::max(stage_.field().inverseDepth[i], 1e-6F) - z) / z);
            }
        }
        if (all.empty()) return {};
        std::sort(all.begin(), all.end());
        const auto bad = all.end() - std::lower_bound(all.begin(), all.end(), 0.1);
        return {all[all.size() / 2], static_cast<double>(bad) / static_cast<double>(all.size()),
                static_cast<double>(all.size()) / static_cast<double>(pixels)};
    }
    [[nodiscard]] const DepthStage& stage() const { return stage_; }
    [[nodiscard]] DepthStage& stage() { return stage_; }

    static constexpr PixelRect kAll{0, 0, 240, 180};

private:
    [[nodiscard]] Pose nextPose() {
        Pose out{Timestamp::fromSeconds(1 + kFrame * frames_++), pose_};
        out.world = world_;
        return out;
    }

    DepthStage stage_;
    Scene scene_ = panelScene();
    PixelRect where_;
    RigidTransform pose_;
    double x_ = 0;
    int frames_ = 0, world_ = 0;
};

TEST(DepthStage, DepthAndKeyframesInAnotherWorldFrameAreForgotten) {
    Walk walk;
    walk.goSideways(20, 0.01);
    ASSERT_GT(walk.errors().complete, 0.5);
    walk.changeWorld();
    walk.goSideways(1, 0.01);
    EXPECT_EQ(walk.errors().complete, 0);
    walk.goSideways(20, 0.01);
    EXPECT_LT(walk.errors().median, 0.02);
}

void expectGood(const Walk::Errors& errors) {
    EXPECT_LT(errors.median, 0.015);
    EXPECT_LT(errors.bad, 0.06);
    EXPECT_GT(errors.complete, 0.85);
    testing::Test::RecordProperty("median", std::to_string(errors.median));
    testing::Test::RecordProperty("bad", std::to_string(errors.bad));
    testing::Test::RecordProperty("complete", std::to_string(errors.complete));
}

TEST(DepthStage, DepthIsUnknownWithoutParallax) {
    Walk walk;
    for (int i = 0; i < 5; ++i)
        walk.go(motion({0.3 * i, -0.4 * i, 0}, {0, 0, 0}));
    EXPECT_EQ(walk.errors().complete, 0);
    EXPECT_EQ(walk.stage().source(), DepthSource::None);
}

TEST(DepthStage, MeasuresAgainstKeyframesWhileTheCameraMoves) {
    Walk walk;
    walk.goSideways(10, 0.01);
    expectGood(walk.errors());
}

TEST(DepthStage, AStillThatCannotBeUsedDoesNotPreventMeasurementsAgainstKeyframes) {
    Walk walk;
    for (int i = 1; i <= 10; ++i)
        walk.goBesideUnusableStill(Walk::at(0.01 * i));
    EXPECT_EQ(walk.stage().source(), DepthSource::Keyframe);
    expectGood(walk.errors());
}

TEST(DepthStage, DepthIsKeptWhileTheCameraStopsAndRotates) {
    Walk walk;
    walk.goSideways(8, 0.012);
    const Walk::Errors before = walk.errors();
    const RigidTransform stop = Walk::at(8 * 0.012);
    for (int i = 0; i < 30; ++i)
        walk.go(stop);
    EXPECT_LT(walk.errors().median, before.median + 0.002);
    EXPECT_GT(walk.errors().complete, 0.95 * before.complete);
    for (int i = 1; i <= 10; ++i)
        walk.go(stop * motion({0.2 * i, 0, 0.5 * i}, {0, 0, 0}));
    EXPECT_LT(walk.errors().median, before.median + 0.005);
    EXPECT_GT(walk.errors().complete, 0.85);
}

TEST(DepthStage, DepthIsMeasuredWhileTheCameraMovesForwards) {
    Walk walk;
    for (int i = 0; i < 14; ++i)
        walk.go(motion({0, 0, 0}, {0.002 * i, 0, 0.03 * i}));
    const Walk::Errors errors = walk.errors();
    EXPECT_LT(errors.median, 0.03);
    EXPECT_GT(errors.complete, 0.8);
}

TEST(DepthStage, DepthIsMeasuredOnlyInTheRequestedRectangle) {
    const PixelRect where{70, 50, 150, 120};
    Walk walk({}, where);
    walk.goSideways(10, 0.01);
    expectGood(walk.errors());
    const InverseDepthField& field = walk.stage().field();
    // Depth that was measured in `where` moves on with the scene, by at most four pixels in each of
    // the ten frames.
    const PixelRect reached = widened(where, 40, field.size);
    for (int y = 0; y < field.size.height; ++y) {
        for (int x = 0; x < field.size.width; ++x) {
            const bool inside = around(reached, {x, y, x + 1, y + 1}) == reached;
            EXPECT_TRUE(inside ||
                        !field.isKnown(static_cast<std::size_t>(y) * field.size.width + x));
        }
    }
}

TEST(DepthStage, AtRestOneStillCorrectsTheDepthOfAThingThatIsGone) {
    Walk walk;
    walk.goSideways(8, 0.012);
    walk.stage().renew();
    walk.rest();
    expectGood(walk.errors());
    Scene wall = panelScene();
    wall.surfaces.pop_back();
    walk.change(wall);
    EXPECT_GT(walk.errors().bad, 0.15) << "no frame has shown yet that the panel is gone";
    walk.rest();
    EXPECT_GT(walk.errors().bad, 0.15) << "without a new still, nothing is measured at rest";
    walk.stage().renew();
    walk.rest();
    expectGood(walk.errors());
    EXPECT_EQ(walk.stage().source(), DepthSource::Still);
}

TEST(DepthStage, AtRestForgottenDepthIsMeasuredAgain) {
    Walk walk;
    walk.goSideways(8, 0.012);
    walk.rest();
    const PixelRect tile{112, 80, 128, 96};
    walk.stage().forget(tile);
    EXPECT_EQ(walk.known(tile), 0);
    walk.rest();
    EXPECT_GT(walk.known(tile), 0.9 * 16 * 16);
    expectGood(walk.errors());
}

TEST(DepthStage, AtRestForgottenDepthBesideTheMeasuredRectangleCausesNoMeasurement) {
    Walk walk;
    walk.measureIn({40, 20, 200, 160});
    walk.stage().renew();
    walk.rest();
    ASSERT_EQ(walk.stage().source(), DepthSource::Still);
    walk.stage().forget(PixelRect{208, 80, 224, 96});
    walk.rest();
    EXPECT_EQ(walk.stage().source(), DepthSource::Carried);
}

TEST(DepthStage, AtRestMovingTheMeasuredRectangleKeepsTheVarianceOfKnownDepth) {
    Walk walk;
    walk.measureIn({40, 20, 200, 160});
    walk.stage().renew();
    walk.rest();
    const std::vector<float> before = walk.stage().field().variance;
    for (int i = 0; i < 6; ++i) {
        walk.measureIn(i % 2 == 0 ? PixelRect{24, 20, 200, 160} : PixelRect{40, 20, 216, 160});
        walk.rest();
    }
    const InverseDepthField& field = walk.stage().field();
    for (int y = 20; y < 160; ++y)
        for (int x = 40; x < 200; ++x) {
            const auto i = static_cast<std::size_t>(y) * field.size.width + x;
            if (!std::isfinite(before[i])) continue;
            EXPECT_EQ(field.variance[i], before[i]) << x << ' ' << y;
        }
    EXPECT_GT(walk.known({24, 40, 40, 140}), 0.8 * 16 * 100) << "new parts are measured";
}

TEST(DepthStage, MostPixelsThatTheStillDoesNotShowHaveNoDepth) {
    const CameraModel video = barrelCamera();
    const StereoRig rig{video, {{480, 360}, 640, 643, 241, 178, {}}, {}};
    const Scene scene = panelScene();
    const RigidTransform T_still_video = motion({0, 0, 0}, {0.06, 0.02, 0});
    const auto workers = std::make_shared<Workers>(2);
    EpipolarSearch search(rig, workers);
    search.setStill(scene.render(rig.still, T_still_video));
    ASSERT_TRUE(search.run(scene.render(video, {}), T_still_video));
    InverseDepthField field(video.size);
    DepthMeasurement(video, workers)
        .run(search, Eigen::Matrix3f::Identity(), 1, {}, Walk::kAll, field);
    int seen = 0, seenKnown = 0, unseen = 0, unseenKnown = 0;
    for (int y = 8; y < 172; ++y)
        for (int x = 8; x < 232; ++x) {
            const Eigen::Vector2d ray = video.unproject({x, y});
            const Eigen::Vector3d point = scene.depth({}, ray) * ray.homogeneous();
            const Eigen::Vector2d at = rig.still.project((T_still_video * point).hnormalized());
            const bool isSeen = at.x() >= 0 && at.y() >= 0 && at.x() < 480 && at.y() < 360;
            const bool isKnown = field.isKnown(static_cast<std::size_t>(y) * 240 + x);
            ++(isSeen ? seen : unseen);
            (isSeen ? seenKnown : unseenKnown) += isKnown ? 1 : 0;
        }
    EXPECT_GT(seenKnown, 0.65 * seen);
    EXPECT_LT(unseenKnown, 0.25 * unseen) << "the share is 0.6 if the still's border is ignored";
}

TEST(DepthStage, DepthIsForgottenOnRequest) {
    Walk walk;
    walk.goSideways(6, 0.012);
    walk.stage().forget(PixelRect{100, 80, 120, 90});
    for (int y = 80; y < 90; ++y)
        for (int x = 100; x < 120; ++x)
            EXPECT_FALSE(walk.stage().field().isKnown(static_cast<std::size_t>(y) * 240 + x));
    walk.stage().forget();
    EXPECT_EQ(walk.errors().complete, 0);
}

}  // namespace
}  // namespace mfar
