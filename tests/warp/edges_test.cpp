#include "tests/engine/gl_test.h"
#include "tests/warp/warp_support.h"

#include <algorithm>

namespace mfar {
namespace {

using test::CastScene;
using WarpEdgesGl = GlTest;

constexpr Size kEdgeLayer{200, 150};
constexpr int kLongEnough = 12;

struct Resting {
    explicit Resting(const WarpOptions& options)
        : scene(test::twoBalls()),
          warp(test::bentCamera(kEdgeLayer), kEdgeLayer, *engine, options) {
        warp.setScene(scene.scene());
        warp.setTracedPicture(tracedPicture(scene.cast({warp.camera(), test::orbit(0)}, 2)));
    }
    std::vector<std::uint8_t> rest(double degrees) {
        return test::bytesOf(
            test::settled(warp, scene, test::orbit(degrees), 2 * kLongEnough).colour);
    }
    /// Answers requests until one is for edges. Returns that request.
    std::optional<HoleRequest> edgesAt(double degrees) {
        for (int i = 0; i < kLongEnough; ++i) {
            warp.run(test::orbit(degrees));
            glFinish();
            auto request = warp.takeRequest();
            if (request && request->edges) return request;
            if (request) warp.answer(test::answered(scene, *request));
        }
        return {};
    }
    RenderedPicture truthAt(double degrees) const {
        return scene.cast({warp.camera(), test::orbit(degrees)}, 2);
    }
    CastScene scene;
    std::unique_ptr<Engine> engine = test::warpEngine();
    Warp warp;
};

TEST_F(WarpEdgesGl, EdgesAreRenderedAgainWhenTheCameraRests) {
    Resting sharpened({}), plain({.sharpenShare = 0});
    const RenderedPicture truth = sharpened.truthAt(2);
    EXPECT_GT(test::psnrInside(sharpened.rest(2), truth),
              test::psnrInside(plain.rest(2), truth) + 3);
}

TEST_F(WarpEdgesGl, EdgePixelsAreRequestedOncePerPoseUpToAShareOfTheObjectsPixels) {
    Resting s({.sharpenShare = 0.1});
    const auto request = s.edgesAt(2);
    ASSERT_TRUE(request);
    EXPECT_TRUE(std::ranges::is_sorted(request->pixels));
    EXPECT_EQ(request->samples, WarpOptions{}.sharpenSamples);
    const RenderedPicture truth = s.truthAt(2);
    const auto objects = std::ranges::count_if(
        truth.id, [](std::uint8_t id) { return id != 0 && id != kCatcherId; });
    EXPECT_GT(request->pixels.size(), 100U);
    EXPECT_LE(static_cast<double>(request->pixels.size()), 0.1 * static_cast<double>(objects));
    s.warp.answer(test::answered(s.scene, *request));
    EXPECT_FALSE(s.edgesAt(2)) << "these edges were already answered";
    EXPECT_TRUE(s.edgesAt(3));
}

TEST_F(WarpEdgesGl, EdgesFadeInAndVanishWithTheFirstMotion) {
    Resting s({.fadeFrames = 4});
    const auto request = s.edgesAt(2);
    ASSERT_TRUE(request);
    const auto meanAt = [&](double degrees) {
        return test::meanGreen(s.warp, test::orbit(degrees), request->pixels);
    };
    const double before = meanAt(2);
    s.warp.answer(test::answeredInWhite(s.scene, *request));
    double last = before;
    for (int i = 1; i <= 4; ++i) {
        const double now = meanAt(2);
        EXPECT_GT(now, last + 3) << i;
        last = now;
    }
    EXPECT_NEAR(meanAt(2), 255, 0.5);
    EXPECT_NEAR(meanAt(2.2), before, 10);
    EXPECT_NEAR(meanAt(2), before, 10)
        << "pixels requested for an earlier pose at rest must not be shown";
}

TEST_F(WarpEdgesGl, RenderedEdgesThatArriveAfterACameraMotionAreIgnored) {
    Resting s({});
    const auto request = s.edgesAt(2);
    ASSERT_TRUE(request);
    const auto moved = test::bytesOf(s.warp.run(test::orbit(3)).colour);
    s.warp.answer(test::answered(s.scene, *request));
    EXPECT_EQ(test::bytesOf(s.warp.run(test::orbit(3)).colour), moved);
    EXPECT_TRUE(s.edgesAt(3)) << "the late answer must not prevent the next request";
}

TEST_F(WarpEdgesGl, ModesThatDoNotRenderHolesRequestNoEdges) {
    for (const HoleFilling filling : {HoleFilling::None, HoleFilling::PushPull}) {
        Resting s({.filling = filling});
        EXPECT_FALSE(s.edgesAt(2));
    }
}

}  // namespace
}  // namespace mfar
