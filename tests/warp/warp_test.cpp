#include "pipeline/warp/warp.h"
#include "tests/engine/gl_test.h"
#include "tests/warp/warp_support.h"

#include <limits>
#include <memory>
#include <numbers>

namespace mfar {
namespace {

using test::CastScene;
using test::psnrInside;
using WarpGl = GlTest;

constexpr Size kLayer{241, 183};

/// A warp of test::twoBalls() whose traced picture was made at 0 degrees.
struct Shown {
    explicit Shown(const WarpOptions& options = {}, CastScene cast = test::twoBalls())
        : scene(std::move(cast)), warp(test::bentCamera(kLayer), kLayer, *engine, options) {
        warp.setScene(scene.scene());
        warp.setTracedPicture(tracedPicture(scene.cast(view(0), 3)));
    }
    [[nodiscard]] RenderView view(double degrees) const {
        return {warp.camera(), test::orbit(degrees)};
    }
    [[nodiscard]] double psnrAt(double degrees) {
        const RigidTransform pose = test::orbit(degrees);
        const LayerPicture& layer = test::settled(warp, scene, pose);
        return psnrInside(test::bytesOf(layer.colour), scene.cast(view(degrees), 3));
    }
    CastScene scene;
    std::unique_ptr<Engine> engine = test::warpEngine();
    Warp warp;
};

TEST_F(WarpGl, AtThePoseOfTheTracedPictureThePictureIsShownUnchanged) {
    Shown s;
    RigidTransform pose = test::orbit(0);
    pose.translation.x() += 2e-5;  // moves pixels by 0.01 px
    const LayerPicture& layer = s.warp.run(pose);
    const auto rgba = test::bytesOf(layer.colour);
    const RenderedPicture traced = s.scene.cast(s.view(0), 3);
    for (std::size_t i = 0; i < traced.colour.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            ASSERT_EQ(rgba[4 * i + c], traced.colour[i][c]);
    EXPECT_EQ(s.warp.counters().unmoved, 1U);
    s.warp.run(test::orbit(0.2));
    EXPECT_EQ(s.warp.counters().warped, 1U);
}

TEST_F(WarpGl, ALayeredPictureIsAlwaysWarped) {
    Shown s;
    RenderedPicture picture = s.scene.cast(s.view(0), 3);
    picture.layered = true;
    s.warp.setTracedPicture(tracedPicture(picture));
    s.warp.run(test::orbit(0));
    EXPECT_EQ(s.warp.counters().unmoved, 0U);
    EXPECT_EQ(s.warp.counters().warped, 1U);
}

TEST_F(WarpGl, AfterSmallRotationsTheLayerIsAsSharpAsInterpolationAllows) {
    Shown s({.filling = HoleFilling::PushPull});
    for (const double degrees : {0.5, 1.0, 2.0})
        EXPECT_GT(s.psnrAt(degrees), 35) << degrees;
}

TEST_F(WarpGl, PsnrRisesFromOpenHolesToFilledHolesToRenderedHoles) {
    std::array<double, 4> psnr{};
    for (int i = 0; i < 4; ++i) {
        Shown s({.filling = static_cast<HoleFilling>(i)},
                {{{{0, 0, 0.1}, 0.09}, {{0.04, -0.25, 0.14}, 0.045}}, true, 1.5});
        psnr[i] = s.psnrAt(15);
    }
    EXPECT_GT(psnr[1], psnr[0] + 1) << "filled holes must be nearer to the truth than open holes";
    EXPECT_GT(psnr[2], psnr[1] + 1)
        << "rendered holes must be nearer to the truth than filled holes";
    EXPECT_NEAR(psnr[3], psnr[2], 0.3)
        << "with filling and rendering, rendered pixels must replace the filled ones";
}

TEST_F(WarpGl, NothingIsShownOutsideSilhouetteAndShadow) {
    Shown s;
    const RenderedPicture truth = s.scene.cast(s.view(5), 4);
    const auto rgba = test::bytesOf(test::settled(s.warp, s.scene, test::orbit(5)).colour);
    double coverage = 0;
    int pixels = 0;
    for (std::size_t i = 0; i < truth.colour.size(); ++i) {
        if (truth.colour[i][3] == 0) {
            EXPECT_LE(rgba[4 * i + 3], 4) << i % kLayer.width << " " << i / kLayer.width;
        }
        coverage += std::abs(rgba[4 * i + 3] - truth.colour[i][3]);
        pixels += truth.colour[i][3] > 0 ? 1 : 0;
    }
    EXPECT_LT(coverage / pixels, 4) << "mean error of coverage [grey levels]";
}

TEST_F(WarpGl, DepthOfTheLayerBelongsToTheCurrentPose) {
    Shown s;
    const RenderedPicture truth = s.scene.cast(s.view(8));
    const auto z = test::valuesOf(s.warp.run(test::orbit(8)).depth);
    int checked = 0;
    for (int y = 1; y + 1 < kLayer.height; ++y)
        for (int x = 1; x + 1 < kLayer.width; ++x) {
            const auto i = static_cast<std::size_t>(y) * kLayer.width + x;
            const auto id = truth.id[i];
            if (id == 0 || truth.id[i - 1] != id || truth.id[i + 1] != id ||
                truth.id[i - kLayer.width] != id || truth.id[i + kLayer.width] != id)
                continue;
            if (id == kCatcherId && truth.colour[i][3] < 8) continue;
            // Tolerance [m]: the facets of a ball are slightly nearer to its centre than the true
            // surface. The error of depth is largest at the ball's edge.
            const float lift = id == kCatcherId ? kShadowLift * truth.depth[i] : 0;
            ASSERT_NEAR(z[i], truth.depth[i] - lift, 0.01) << x << " " << y;
            ++checked;
        }
    EXPECT_GT(checked, 5000);
}

TEST_F(WarpGl, LightOnRealSurfacesWithoutAlphaIsShownAtItsDepth) {
    Shown s;
    constexpr std::array<std::uint8_t, 4> kGlow{12, 9, 6, 0};
    const auto lit = [&](double degrees) {
        RenderedPicture picture = s.scene.cast(s.view(degrees));
        for (std::size_t i = 0; i < picture.id.size(); ++i)
            if (picture.id[i] == kCatcherId) picture.colour[i] = kGlow;
        return picture;
    };
    s.warp.setTracedPicture(tracedPicture(lit(0)));
    const RenderedPicture truth = lit(3);
    const LayerPicture& layer = s.warp.run(test::orbit(3));
    const auto z = test::valuesOf(layer.depth);
    const auto rgba = test::bytesOf(layer.colour);
    int shown = 0, all = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        if (truth.id[i] != kCatcherId) continue;
        ++all;
        if (std::abs(rgba[4 * i] - kGlow[0]) > 1 || rgba[4 * i + 3] != 0) continue;
        ASSERT_NEAR(z[i], (1 - kShadowLift) * truth.depth[i], 0.01);
        ++shown;
    }
    EXPECT_GT(shown, 0.9 * all);
    EXPECT_GT(all, 1000);
}

TEST_F(WarpGl, ExtremePosesGiveFiniteDepthsAndInvalidPosesAnEmptyLayer) {
    Shown s;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    RigidTransform broken = test::orbit(0);
    broken.translation.y() = kNan;
    EXPECT_TRUE(s.warp.run(broken).bounds.empty());
    RigidTransform away = test::orbit(0);
    away.rotation = away.rotation * Eigen::Quaterniond(0, 0, 1, 0);  // the camera looks away
    EXPECT_TRUE(s.warp.run(away).bounds.empty());
    // The camera is inside a ball, near its surface or far away; upright, rolled by 90 degrees and
    // upside down.
    for (const double distance : {0.001, 0.05, 0.09, 0.1001, 0.14, 50.0, 1e5})
        for (const double degrees : {0.0, 90.0, 180.0}) {
            RigidTransform rolled = test::orbit(30, distance, 1);
            rolled.rotation = rolled.rotation * Eigen::AngleAxisd(degrees * std::numbers::pi / 180,
                                                                  Eigen::Vector3d::UnitZ());
            const LayerPicture& layer = s.warp.run(rolled);
            for (const float z : test::valuesOf(layer.depth))
                ASSERT_TRUE(std::isfinite(z) && z >= 0) << distance << " " << degrees;
        }
    EXPECT_GT(
        psnrInside(test::bytesOf(s.warp.run(test::orbit(1)).colour), s.scene.cast(s.view(1), 3)),
        33);
}

TEST_F(WarpGl, InvalidAndEmptyTracedPicturesAreHarmless) {
    Shown s({.filling = HoleFilling::PushPull});
    RenderedPicture picture = s.scene.cast(s.view(0));
    for (std::size_t i = 0; i < picture.depth.size(); i += 3)
        picture.depth[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : -1e30F;
    s.warp.setTracedPicture(tracedPicture(picture));
    for (const float z : test::valuesOf(s.warp.run(test::orbit(3)).depth))
        ASSERT_TRUE(std::isfinite(z));
    std::ranges::fill(picture.id, std::uint8_t{0});
    std::ranges::fill(picture.depth, 0.0F);
    std::ranges::fill(picture.colour, std::array<std::uint8_t, 4>{});
    s.warp.setTracedPicture(tracedPicture(picture));
    const auto rgba = test::bytesOf(s.warp.run(test::orbit(0)).colour);
    EXPECT_EQ(std::ranges::count(rgba, 0), static_cast<long>(rgba.size()));
    s.warp.dropTracedPicture();
    EXPECT_TRUE(s.warp.run(test::orbit(0)).bounds.empty());
}

TEST_F(WarpGl, EmptySceneShowsNothing) {
    const auto engine = test::warpEngine();
    Warp warp(test::bentCamera(kLayer), kLayer, *engine);
    EXPECT_TRUE(warp.run(test::orbit(0)).bounds.empty());
    warp.setScene({});
    CastScene bare{{}, false, 1};
    warp.setTracedPicture(tracedPicture(bare.cast({warp.camera(), test::orbit(0)})));
    EXPECT_TRUE(warp.run(test::orbit(1)).bounds.empty());
    EXPECT_EQ(warp.counters().empty, 2U);
}

TEST_F(WarpGl, AnObjectLargerThanTheViewIsWarped) {
    Shown s({.filling = HoleFilling::PushPull}, {{{{0, 0, 0.1}, 0.5}}, false, 1});
    EXPECT_GT(s.psnrAt(1), 33);
}

TEST_F(WarpGl, ATracedPictureOfAnotherResolutionIsAlwaysWarped) {
    Shown s({.filling = HoleFilling::PushPull});
    const RenderView small{s.warp.camera().scaledTo({181, 137}), test::orbit(0)};
    s.warp.setTracedPicture(tracedPicture(s.scene.cast(small, 3)));
    const auto rgba = test::bytesOf(s.warp.run(test::orbit(0)).colour);
    EXPECT_EQ(s.warp.counters().warped, 1U);
    EXPECT_GT(psnrInside(rgba, s.scene.cast(s.view(0), 3)), 30);
}

TEST_F(WarpGl, LayersOfOddSizesAreWarped) {
    for (const Size size : {Size{1, 1}, Size{2, 3}, Size{7, 5}, Size{63, 65}}) {
        const CastScene scene = test::twoBalls();
        const auto engine = test::warpEngine();
        Warp warp(test::bentCamera(kLayer), size, *engine);
        warp.setScene(scene.scene(16));
        warp.setTracedPicture(tracedPicture(scene.cast({warp.camera(), test::orbit(0)})));
        const RigidTransform pose = test::orbit(10);
        const LayerPicture& layer = test::settled(warp, scene, pose, 3);
        EXPECT_TRUE(layer.bounds.x1 <= size.width && layer.bounds.y1 <= size.height);
    }
}

TEST_F(WarpGl, MeshesOfManyTrianglesAreWarped) {
    const CastScene scene{{{{0, 0, 0.1}, 0.09}}, true, 1};
    const auto engine = test::warpEngine();
    Warp warp(test::bentCamera(kLayer), kLayer, *engine, {.filling = HoleFilling::PushPull});
    warp.setScene(scene.scene(720));
    const RenderView from{warp.camera(), test::orbit(0)}, to{warp.camera(), test::orbit(2)};
    warp.setTracedPicture(tracedPicture(scene.cast(from, 3)));
    EXPECT_GT(psnrInside(test::bytesOf(warp.run(to.T_world_camera).colour), scene.cast(to, 3)), 34);
}

TEST_F(WarpGl, OptionsOutOfRangeAreRefused) {
    const CameraModel camera = test::bentCamera(kLayer);
    const auto engine = test::warpEngine();
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const WarpOptions& options :
         {WarpOptions{.mostRequested = 0}, WarpOptions{.fadeFrames = -1},
          WarpOptions{.fadeFrames = 101}, WarpOptions{.leastMotion = kNan},
          WarpOptions{.leastMotion = -0.1}, WarpOptions{.filling = static_cast<HoleFilling>(4)}})
        EXPECT_THROW(Warp(camera, kLayer, *engine, options), std::invalid_argument);
}

}  // namespace
}  // namespace mfar
