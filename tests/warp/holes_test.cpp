#include "tests/engine/gl_test.h"
#include "tests/warp/warp_support.h"

#include <algorithm>
#include <limits>

namespace mfar {
namespace {

using test::CastScene;
using WarpHolesGl = GlTest;

constexpr Size kHoleLayer{200, 150};
constexpr double kTurn = 50;  // [degrees]; uncovers a wide strip of each ball

struct Turned {
    explicit Turned(const WarpOptions& options)
        : scene(test::twoBalls()),
          warp(test::bentCamera(kHoleLayer), kHoleLayer, *engine, options) {
        warp.setScene(scene.scene());
        warp.setTracedPicture(tracedPicture(scene.cast({warp.camera(), test::orbit(0)}, 2)));
    }
    std::optional<HoleRequest> requestAt(double degrees) {
        warp.run(test::orbit(degrees));
        glFinish();
        return warp.takeRequest();
    }
    CastScene scene;
    std::unique_ptr<Engine> engine = test::warpEngine();
    Warp warp;
};

// A hole is a pixel of the new view whose surface the traced picture does not show.
TEST_F(WarpHolesGl, HolesOfTheTracedPictureAreRequested) {
    Turned s({});
    const auto request = s.requestAt(kTurn);
    ASSERT_TRUE(request);
    EXPECT_GT(request->pixels.size(), 50U);
    EXPECT_TRUE(std::ranges::is_sorted(request->pixels));
    const RenderedPicture now = s.scene.cast({s.warp.camera(), test::orbit(kTurn)});
    const RenderedPicture before = s.scene.cast({s.warp.camera(), test::orbit(0)});
    int hidden = 0, surfaces = 0;
    for (const std::uint32_t pixel : request->pixels) {
        if (now.id[pixel] == 0 || now.id[pixel] == kCatcherId) continue;
        ++surfaces;
        const Eigen::Vector2d at(pixel % kHoleLayer.width, pixel / kHoleLayer.width);
        const Eigen::Vector3d p = now.depth[pixel] * s.warp.camera().unproject(at).homogeneous();
        const Eigen::Vector3d q = test::orbit(0).inverse() * (test::orbit(kTurn) * p);
        const Eigen::Vector2d r = s.warp.camera().project(q.hnormalized());
        const auto x = std::lround(r.x()), y = std::lround(r.y());
        const auto i = static_cast<std::size_t>(y * kHoleLayer.width + x);
        hidden +=
            before.id[i] != now.id[pixel] || std::abs(before.depth[i] - q.z()) > 0.003 ? 1 : 0;
    }
    // The traced picture may show up to a fifth of the requested pixels. They are at the edge of a
    // ball, where rounding decides if a pixel counts as hidden.
    EXPECT_GT(surfaces, 100);
    EXPECT_GT(surfaces, 0.95 * static_cast<double>(request->pixels.size()));
    EXPECT_GT(hidden, 0.8 * surfaces);
}

TEST_F(WarpHolesGl, OnlyOneRequestIsOpenAtATimeAndItsAnswerFillsTheHoles) {
    Turned s({});
    const auto request = s.requestAt(kTurn);
    ASSERT_TRUE(request);
    EXPECT_FALSE(s.requestAt(kTurn)) << "the first request is not answered yet";
    s.warp.answer(test::answered(s.scene, *request));
    const auto second = s.requestAt(kTurn);
    const std::size_t left = second ? second->pixels.size() : 0;
    EXPECT_LT(left, request->pixels.size() / 20);
    EXPECT_EQ(s.warp.counters().answered, request->pixels.size());
}

TEST_F(WarpHolesGl, AnsweredPixelsAreReusedAfterTheCameraMoved) {
    Turned s({.filling = HoleFilling::Rerender});
    const auto request = s.requestAt(kTurn);
    ASSERT_TRUE(request);
    s.warp.answer(test::answered(s.scene, *request));
    const auto second = s.requestAt(kTurn + 1.5);
    const std::size_t left = second ? second->pixels.size() : 0;
    EXPECT_LT(left, request->pixels.size() / 3)
        << "only pixels that the further rotation uncovers may be requested";
}

TEST_F(WarpHolesGl, WhileTheCameraRestsNoPixelIsRequestedTwice) {
    Turned s({.mostRequested = 200});
    std::vector<int> requests(static_cast<std::size_t>(kHoleLayer.width) * kHoleLayer.height);
    std::optional<HoleRequest> request;
    for (int i = 0; i < 60; ++i) {
        request = s.requestAt(kTurn);
        if (!request) continue;
        HoleAnswer answer = test::answered(s.scene, *request);
        // The tracer sees no object there, as through a hole of an alpha mask.
        std::ranges::fill(answer.id, 0);
        s.warp.answer(answer);
        if (request->edges) continue;
        for (const std::uint32_t pixel : request->pixels)
            ASSERT_EQ(++requests[pixel], 1) << pixel;
    }
    EXPECT_FALSE(request);
    EXPECT_GT(s.warp.counters().requested, 2 * 200U);
}

TEST_F(WarpHolesGl, AnswersFadeInOverSeveralFrames) {
    Turned s({.fadeFrames = 4});
    const auto request = s.requestAt(kTurn);
    ASSERT_TRUE(request);
    const auto mean = [&] { return test::meanGreen(s.warp, test::orbit(kTurn), request->pixels); };
    const double filled = mean();
    s.warp.answer(test::answeredInWhite(s.scene, *request));
    double last = filled;
    for (int i = 1; i <= 4; ++i) {
        const double now = mean();
        EXPECT_GT(now, last + 3) << i;
        last = now;
    }
    EXPECT_NEAR(mean(), last, 0.5);
}

TEST_F(WarpHolesGl, IfThereAreTooManyHolesAnEvenSampleOfThemIsRequested) {
    Turned all({}), few({.mostRequested = 100});
    const auto every = all.requestAt(kTurn), some = few.requestAt(kTurn);
    ASSERT_TRUE(every && some);
    ASSERT_EQ(some->pixels.size(), 100U);
    EXPECT_TRUE(std::ranges::includes(every->pixels, some->pixels));
    const auto meanRow = [](const std::vector<std::uint32_t>& pixels) {
        std::uint64_t sum = 0;
        for (const std::uint32_t p : pixels)
            sum += p / static_cast<unsigned>(kHoleLayer.width);
        return static_cast<double>(sum) / static_cast<double>(pixels.size());
    };
    EXPECT_NEAR(meanRow(every->pixels), meanRow(some->pixels), 8);
}

TEST_F(WarpHolesGl, ModesThatDoNotRenderHolesRequestNoPixels) {
    for (const HoleFilling filling : {HoleFilling::None, HoleFilling::PushPull}) {
        Turned s({.filling = filling});
        EXPECT_FALSE(s.requestAt(kTurn));
        EXPECT_GT(s.warp.counters().openHoles, 50);
    }
}

TEST_F(WarpHolesGl, HolesInTheShadowAreFilledFromItsSurroundingsAndNotRequested) {
    for (const HoleFilling filling :
         {HoleFilling::Both, HoleFilling::Rerender, HoleFilling::PushPull, HoleFilling::None}) {
        SCOPED_TRACE(static_cast<int>(filling));
        Turned s({.filling = filling});
        const RigidTransform now = test::orbit(15);
        const auto rgba = test::bytesOf(s.warp.run(now).colour);
        glFinish();
        const auto request = s.warp.takeRequest();
        const auto state = test::bytesOf(s.warp.state());
        const RenderedPicture truth = s.scene.cast({s.warp.camera(), now});
        int holes = 0;
        double error = 0, shadow = 0;
        for (std::uint32_t i = 0; i < truth.id.size(); ++i) {
            if (state[4 * i] != kCatcherId || state[4 * i + 1] < 255) continue;
            EXPECT_FALSE(request && std::ranges::binary_search(request->pixels, i));
            if (truth.id[i] != kCatcherId) continue;
            ++holes;
            error += std::abs(rgba[4 * i + 3] - truth.colour[i][3]);
            shadow += truth.colour[i][3];
        }
        EXPECT_GT(holes, 50);
        EXPECT_GT(shadow, 10 * holes)
            << "sum of the true shadow's alpha in the holes, 0 to 255 each";
        if (filling == HoleFilling::None) {
            EXPECT_GT(error, 0.8 * shadow);
        } else {
            EXPECT_LT(error, 0.5 * shadow);
        }
    }
}

TEST_F(WarpHolesGl, PixelsOfAppearingObjectsAreFilledAtOnce) {
    const CastScene scene = test::twoBalls();
    const auto engine = test::warpEngine();
    Warp warp(test::bentCamera(kHoleLayer), kHoleLayer, *engine,
              {.filling = HoleFilling::PushPull});
    warp.setScene(scene.scene());
    const RenderedPicture before = scene.cast({warp.camera(), test::orbit(200)}, 2);
    ASSERT_EQ(std::ranges::count(before.id, 2), 0);
    warp.setTracedPicture(tracedPicture(before));
    const RigidTransform now = test::orbit(190);
    const auto rgba = test::bytesOf(warp.run(now).colour);
    const RenderedPicture truth = scene.cast({warp.camera(), now}, 2);
    int uncovered = 0;
    for (std::size_t i = 0; i < truth.id.size(); ++i) {
        if (truth.id[i] != 2 || truth.colour[i][3] < 255) continue;
        ++uncovered;
        EXPECT_GT(rgba[4 * i + 3], 240) << "pixel " << i;
    }
    EXPECT_GT(uncovered, 20);
}

TEST_F(WarpHolesGl, InvalidAnswersAreRefusedAndAnswersOfAnotherSceneIgnored) {
    Turned s({});
    const auto request = s.requestAt(kTurn);
    ASSERT_TRUE(request);
    const HoleAnswer good = test::answered(s.scene, *request);
    HoleAnswer bad = good;
    bad.depth.pop_back();
    EXPECT_THROW(s.warp.answer(bad), std::invalid_argument);
    bad = good;
    bad.pixels[0] = kHoleLayer.width * kHoleLayer.height;
    EXPECT_THROW(s.warp.answer(bad), std::invalid_argument);
    bad = good;
    bad.view.T_world_camera.translation.x() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(s.warp.answer(bad), std::invalid_argument);
    s.warp.setScene(s.scene.scene());
    s.warp.answer(good);
    EXPECT_EQ(s.warp.counters().answered, 0U);
}

}  // namespace
}  // namespace mfar
