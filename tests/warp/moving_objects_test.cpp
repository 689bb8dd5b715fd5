#include "pipeline/scene/scene_parts.h"
#include "pipeline/warp/warp.h"
#include "tests/engine/gl_test.h"
#include "tests/warp/warp_support.h"

#include <memory>
#include <utility>
#include <vector>

namespace mfar {
namespace {

using test::CastScene;
using WarpMovingGl = GlTest;

constexpr Size kMovingLayer{241, 183};

std::vector<RigidTransform> posesOf(const CastScene& scene) {
    std::vector<RigidTransform> out;
    for (const CastScene::Ball& ball : scene.balls)
        out.push_back({Eigen::Quaterniond::Identity(), ball.centre});
    return out;
}

/// A warp of two balls. The second one moves by itself.
struct Moving {
    explicit Moving(const WarpOptions& options = {.filling = HoleFilling::PushPull})
        : warp(test::bentCamera(kMovingLayer), kMovingLayer, *engine, options) {
        Scene models = before.scene();
        models.objects[1].path = std::make_shared<const RigidPath>();
        warp.setScene(models);
        RenderedPicture picture = before.cast({warp.camera(), test::orbit(0)}, 3);
        picture.poses = posesOf(before);
        warp.setTracedPicture(tracedPicture(picture));
    }
    /// The balls when the second one has moved by about a tenth of its radius.
    [[nodiscard]] CastScene after() const {
        CastScene out = before;
        out.balls[1].centre += 0.1 * out.balls[1].radius * Eigen::Vector3d(1, 0.5, 0.3);
        return out;
    }
    /// PSNR inside the balls, compared with colours that move with the balls [dB].
    [[nodiscard]] double psnr(const CastScene& now, double degrees) {
        const LayerPicture& layer = warp.run(test::orbit(degrees), posesOf(now));
        // Each point of the moved ball must have the colour that it had before the motion.
        RenderedPicture truth = now.cast({warp.camera(), test::orbit(degrees)}, 3);
        const Eigen::Vector3d moved = now.balls[1].centre - before.balls[1].centre;
        const RigidTransform back{test::orbit(degrees).rotation,
                                  test::orbit(degrees).translation - moved};
        const RenderedPicture ball = before.cast({warp.camera(), back}, 3);
        for (std::size_t i = 0; i < truth.id.size(); ++i)
            if (truth.id[i] == 2) truth.colour[i] = ball.colour[i];
        return test::psnrInside(test::bytesOf(layer.colour), truth);
    }

    CastScene before = test::twoBalls();
    std::unique_ptr<Engine> engine = test::warpEngine();
    Warp warp;
};

TEST_F(WarpMovingGl, ColoursMoveWithTheirObject) {
    Moving s;
    EXPECT_GT(s.psnr(s.after(), 0), 32);
    EXPECT_GT(s.psnr(s.after(), 1), 32) << "the camera moves, too";
}

TEST_F(WarpMovingGl, MovableObjectsAtTheirOldPosesLookTheSameAsStaticOnes) {
    Moving s;
    const std::vector<std::uint8_t> moving =
        test::bytesOf(s.warp.run(test::orbit(1), posesOf(s.before)).colour);
    RenderedPicture picture = s.before.cast({s.warp.camera(), test::orbit(0)}, 3);
    s.warp.setTracedPicture(tracedPicture(picture));
    const std::vector<std::uint8_t> still = test::bytesOf(s.warp.run(test::orbit(1)).colour);
    int different = 0;
    for (std::size_t i = 0; i < still.size(); ++i)
        different += std::abs(still[i] - moving[i]) > 1 ? 1 : 0;
    EXPECT_LT(different, 40) << "rounding of the transforms may change a few pixels at edges";
}

TEST_F(WarpMovingGl, WithPosesOfMovingObjectsTheViewNeverCountsAsAtRest) {
    Moving s;
    for (int frame = 0; frame < 20; ++frame) {
        s.warp.run(test::orbit(0), posesOf(s.before));
        const auto request = s.warp.takeRequest();
        EXPECT_FALSE(request && request->edges) << frame;
    }
    EXPECT_EQ(s.warp.counters().unmoved, 0U);
}

// The second ball turns by 1.5 rad. Only individually rendered pixels can show its new side.
TEST_F(WarpMovingGl, HolesOfATurnedObjectAreRenderedAtItsPose) {
    Moving s({.filling = HoleFilling::Rerender, .fadeFrames = 0});
    std::vector<RigidTransform> poses = posesOf(s.before);
    poses[1].rotation = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitZ());
    const auto alphaSum = [&] {
        const auto rgba = test::bytesOf(s.warp.run(test::orbit(0), poses).colour);
        double sum = 0;
        for (std::size_t i = 3; i < rgba.size(); i += 4)
            sum += rgba[i];
        return sum;
    };
    const double open = alphaSum();
    glFinish();
    const auto request = s.warp.takeRequest();
    ASSERT_TRUE(request);
    ASSERT_EQ(request->poses.size(), 2U);
    EXPECT_EQ(request->poses[1].rotation.coeffs(), poses[1].rotation.coeffs());
    HoleAnswer answer = test::answered(s.before, *request);
    answer.poses = request->poses;
    s.warp.answer(answer);
    EXPECT_GT(alphaSum(), open + 255 * 100);
    // The rendered pixels turn with the ball.
    poses[1].rotation = Eigen::AngleAxisd(1.55, Eigen::Vector3d::UnitZ());
    EXPECT_GT(alphaSum(), open + 255 * 90);
}

}  // namespace
}  // namespace mfar
