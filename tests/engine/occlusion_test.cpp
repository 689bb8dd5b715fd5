#include "pipeline/gles/layer_composite.h"
#include "pipeline/simd/occlusion_step.h"
#include "tests/engine/engine_name.h"
#include "tests/engine/occlusion_case.h"
#include "tests/engine/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <tuple>

namespace mfar {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(Engines, OcclusionTest,
                         testing::Values(EngineKind::Gles, EngineKind::Simd), engineOfTest);

LaidLayer layerAt(double z) {
    LaidLayer layer;
    layer.z = [z](int, int) { return z; };
    return layer;
}

struct Sides {
    Size video, output;
};
class OcclusionSizes : public OcclusionCase,
                       public testing::WithParamInterface<std::tuple<EngineKind, Sides>> {};

TEST_P(OcclusionSizes, VisibilityMatchesTheOracleAtEverySize) {
    const auto& [engine, sides] = GetParam();
    const auto& [video, output] = sides;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> inverseDepth(0.3, 0.7), sigma(0.002, 0.05), unit(0, 1);
    const Waves waves(3, 6, 50, 40);
    const double step = static_cast<double>(video.width) / output.width;
    twin::Scene scene{
        waves.shoot(video, {}), waves.shoot(output, {.step = step, .footprint = step}), {}};
    for (int i = 0; i < video.width * video.height; ++i) {
        scene.real.push_back({inverseDepth(random), sigma(random)});
        if (unit(random) < 0.1) scene.real.back().inverseDepth = kNan;
        if (unit(random) < 0.1) scene.real.back().sigma = 0;
    }
    LaidLayer layer;
    layer.z = [](int x, int y) { return 2 + 0.6 * std::sin(0.05 * x) * std::cos(0.04 * y); };
    for (const CompositeOptions& o :
         {CompositeOptions{}, CompositeOptions{.bias = 0, .softness = 5, .virtualSigma = 0.02},
          CompositeOptions{.bias = 1, .softness = 0.5, .virtualSigma = 0, .likeness = 60}})
        expectOracles(laidOver(engine, scene, layer, o), scene, layer, o);
}

INSTANTIATE_TEST_SUITE_P(
    Engines, OcclusionSizes,
    testing::Combine(testing::Values(EngineKind::Gles, EngineKind::Simd),
                     testing::Values(Sides{{53, 37}, {191, 133}}, Sides{{16, 16}, {16, 16}},
                                     Sides{{17, 31}, {601, 40}}, Sides{{64, 48}, {33, 21}},
                                     Sides{{40, 30}, {160, 120}})));

TEST_P(OcclusionTest, ClearlyVisibleAndClearlyHiddenPixelsMatchTheOracle) {
    twin::Scene scene = plainScene({0.4, 0.01});
    for (std::size_t i = 0; i < scene.real.size(); ++i)
        if (i % kCoarse.width > 20) scene.real[i].inverseDepth = 0.8;
    LaidLayer layer;
    layer.z = [](int, int y) { return 1.2 + 0.01 * y; };
    const LaidOver got = run(scene, layer);
    expectOracles(got, scene, layer);
    EXPECT_GT(std::ranges::count(got.visibility, 0), 4000);
    EXPECT_GT(std::ranges::count(got.visibility, 255), 4000);
}

TEST_P(OcclusionTest, UnknownDepthNeverOccludes) {
    for (const double bad : {0.0, -0.0, -1.0, -1e30, 1e-42, kNan, kInfinite, -kInfinite})
        EXPECT_EQ(run(plainScene({bad, 0.01}), {}).visibleEverywhere(), 1)
            << "inverse depth " << bad;
    for (const double bad : {0.0, -0.0, -1.0, kNan, kInfinite, -kInfinite})
        EXPECT_EQ(run(plainScene({100, bad}), {}).visibleEverywhere(), 1) << "sigma " << bad;
}

TEST_P(OcclusionTest, UnknownDepthBesideKnownDepthNeverOccludes) {
    twin::Scene scene = plainScene({1, 0.01});
    for (std::size_t i = 0; i < scene.real.size(); i += 3)
        scene.real[i].inverseDepth = kNan;
    expectOracles(run(scene, {}), scene, {});
}

TEST_P(OcclusionTest, ExtremeValidDepthsAreComparedCorrectly) {
    struct Case {
        twin::RealSample real;
        double z, visible;
    };
    for (const Case& c :
         {Case{{1e5, 1e-19}, 2, 0}, Case{{2e-6, 1e-19}, 2, 1}, Case{{1e5, 9e5}, 2, 1},
          Case{{1e-5, 1e-12}, 9e5, 0}, Case{{9e5, 1}, 2e-4, 0}, Case{{0.5, 1e-19}, 2, 1}})
        for (const CompositeOptions& o : {CompositeOptions{}, {.virtualSigma = 0}})
            EXPECT_EQ(run(plainScene(c.real), layerAt(c.z), o).visibleEverywhere(), c.visible)
                << c.real.inverseDepth << " " << c.real.sigma;
}

TEST_P(OcclusionTest, ALayerWithoutDepthIsNotDrawn) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const double bad : {0.0, -0.0, -2.0, 1e-42, kNan, kInfinite, -kInfinite})
        EXPECT_EQ(run(scene, layerAt(bad)).shown, scene.picture.bytes) << bad;
}

TEST_P(OcclusionTest, VirtualObjectIsVisibleAtEqualDepth) {
    constexpr double kSigma = 0.01;
    const CompositeOptions o{.bias = 2, .softness = 2, .virtualSigma = 0};
    for (const auto& [sigmas, visible] :
         {std::pair{-50.0, 1.0}, {0.0, 1.0}, {1.9, 1.0}, {3.0, 0.5}, {4.1, 0.0}, {50.0, 0.0}})
        EXPECT_NEAR(run(plainScene({0.5 + sigmas * kSigma, kSigma}), {}, o).visibleAt(90, 60),
                    visible, 0.01)
            << sigmas;
}

TEST_P(OcclusionTest, LayerIsBlendedByItsVisibility) {
    const twin::Scene scene = plainScene({0.53, 0.01});
    constexpr std::array<std::uint8_t, 4> kColour{120, 60, 0, 128};
    LaidLayer layer;
    layer.colour = [&](int, int) { return kColour; };
    layer.bounds = {30, 20, 131, 103};
    const LaidOver got = run(scene, layer, {.bias = 2, .softness = 2, .virtualSigma = 0});
    EXPECT_NEAR(got.visibleAt(90, 60), 0.5, 0.01);
    for (int y = 0; y < kFine.height; ++y)
        for (int x = 0; x < kFine.width; ++x) {
            const PixelRect& b = layer.bounds;
            const bool in = x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1;
            const double v = in ? got.visibleAt(x, y) : 0;
            for (int c = 0; c < 3; ++c) {
                const double before = scene.picture.bytes[4UL * (1UL * y * kFine.width + x) + c];
                const double wanted = v * kColour[c] + (1 - v * kColour[3] / 255) * before;
                ASSERT_NEAR(got.at(x, y, c), wanted, in ? 1.1 : 0) << x << " " << y;
            }
        }
}

// The second colour is invalid, because it is not premultiplied by its alpha of 0. Blending it must
// not overflow.
TEST_P(OcclusionTest, OpaqueLayersReplaceThePicture) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const std::array<std::uint8_t, 4>& colour :
         {std::array<std::uint8_t, 4>{1, 254, 77, 255}, {255, 255, 255, 0}}) {
        LaidLayer layer;
        layer.colour = [&](int, int) { return colour; };
        const LaidOver got = run(scene, layer);
        for (std::size_t i = 0; i < got.shown.size(); ++i)
            if (i % 4 != 3) {
                ASSERT_EQ(got.shown[i], colour[3] == 0 ? 255 : colour[i % 4]);
            }
    }
}

TEST_P(OcclusionTest, BoundsOfTheLayerAreClippedAtTheBordersOfThePicture) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const PixelRect& b : {PixelRect{-50, -9, 1000, 999}, PixelRect{180, 120, 500, 140}}) {
        LaidLayer layer;
        layer.bounds = b;
        const LaidOver got = run(scene, layer);
        for (int y = std::max(b.y0, 0); y < kFine.height; ++y)
            for (int x = std::max(b.x0, 0); x < kFine.width; ++x)
                ASSERT_EQ(got.at(x, y, 0), 200);
    }
}

TEST_P(OcclusionTest, LayersWithEmptyBoundsAreNotDrawn) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const PixelRect& b : {PixelRect{}, PixelRect{9, 9, 9, 20}, PixelRect{-20, 0, -1, 30},
                               PixelRect{191, 0, 300, 30}, PixelRect{50, 50, 20, 60}}) {
        LaidLayer layer;
        layer.bounds = b;
        EXPECT_EQ(run(scene, layer).shown, scene.picture.bytes);
    }
}

TEST_P(OcclusionTest, OptionsOutOfRangeAreRefused) {
    const auto make = [](const CompositeOptions& o) {
        if (GetParam() == EngineKind::Gles)
            LayerComposite(kCoarse, kFine, o);
        else
            simd::OcclusionStep(kCoarse, kFine, kFine, o, nullptr);
    };
    for (const double bad : {-1.0, 1e9, kNan, kInfinite}) {
        EXPECT_THROW(make({.bias = bad}), std::invalid_argument);
        EXPECT_THROW(make({.virtualSigma = bad}), std::invalid_argument);
    }
    for (const double bad : {0.0, -1.0, 1e9, kNan}) {
        EXPECT_THROW(make({.softness = bad}), std::invalid_argument);
        EXPECT_THROW(make({.likeness = bad}), std::invalid_argument);
    }
}

/// A near object to the left of a straight edge through (26.3, 18) [video px].
struct EdgeScene {
    double degrees;        ///< angle between the edge and a column
    double contrast = 90;  ///< difference across the edge [grey levels]
    Size coarse, fine;

    /// Signed distance from the edge [video px]; positive to its right. u, v: position [video px].
    [[nodiscard]] double beyond(double u, double v) const {
        const double a = degrees * std::numbers::pi / 180;
        return (u - 26.3) * std::cos(a) + (v - 18) * std::sin(a);
    }
    [[nodiscard]] TestPicture shoot(Size size) const {
        TestPicture p(size, PixelFormat::Rgba8, 255);
        const double step = static_cast<double>(coarse.width) / size.width;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                int near = 0;
                for (int i = 0; i < 64; ++i) {
                    const int row = i / 8;
                    near += beyond((x + (i % 8 + 0.5) / 8) * step - 0.5,
                                   (y + (row + 0.5) / 8) * step - 0.5) < 0
                                ? 1
                                : 0;
                }
                std::fill_n(p.at(x, y), 3,
                            static_cast<std::uint8_t>(std::lround(80 + contrast * near / 64)));
            }
        return p;
    }
    [[nodiscard]] twin::Scene scene() const {
        twin::Scene s{shoot(coarse), shoot(fine), {}};
        for (int y = 0; y < coarse.height; ++y)
            for (int x = 0; x < coarse.width; ++x)
                s.real.push_back({beyond(x, y) < 0 ? 1.0 : 0.25, 0.01});
        return s;
    }
    /// Mean distance between the true edge and the line of half visibility [video px]: the area
    /// between the two lines, divided by the length of the edge.
    [[nodiscard]] double errorOf(const LaidOver& got) const {
        const double step = static_cast<double>(coarse.width) / fine.width;
        double wrong = 0;
        int rows = 0;
        for (int y = 12; y < fine.height - 12; ++y, ++rows)
            for (int x = 0; x < fine.width; ++x) {
                const double d = beyond((x + 0.5) * step - 0.5, (y + 0.5) * step - 0.5);
                if ((got.visibleAt(x, y) > 0.5) != (d > 0)) wrong += step * step;
            }
        return wrong * std::cos(degrees * std::numbers::pi / 180) / (rows * step);
    }
};

TEST_P(OcclusionTest, PartlyOccludedObjectEndsAtTheOccludersEdgeInThePicture) {
    for (const double degrees : {0.0, 7.0, -20.0, 38.0})
        for (const auto& [contrast, most] : {std::pair{90.0, 0.08}, {0.0, 0.3}}) {
            const EdgeScene edge{degrees, contrast, kCoarse, kFine};
            EXPECT_LE(edge.errorOf(run(edge.scene(), {})), most) << degrees << " " << contrast;
        }
}

class ScaledLayer : public OcclusionTest {
protected:
    static constexpr Size kVideo{40, 30}, kOutput{160, 120};

    static LaidOver runOverBlack(const LaidLayer& layer) {
        return run({TestPicture(kVideo), TestPicture(kOutput),
                    std::vector<twin::RealSample>(1UL * kVideo.width * kVideo.height, {0, 0})},
                   layer);
    }
};
INSTANTIATE_TEST_SUITE_P(Engines, ScaledLayer, testing::Values(EngineKind::Gles, EngineKind::Simd),
                         engineOfTest);

TEST_P(ScaledLayer, ColoursAreInterpolatedLinearlyBetweenPixelsOfTheLayer) {
    constexpr Size kHalf{80, 60};
    // Tolerance: the texture units of software renderers have weights of 8 bits.
    const double most = GetParam() == EngineKind::Gles ? 1.01 : 0.53;
    LaidLayer layer{kHalf};
    layer.colour = [](int x, int y) {
        return std::array<std::uint8_t, 4>{static_cast<std::uint8_t>(3 * x),
                                           static_cast<std::uint8_t>(4 * y), 0, 255};
    };
    const LaidOver got = runOverBlack(layer);
    for (int x = 2; x < kOutput.width - 2; ++x)
        ASSERT_NEAR(got.at(x, 50, 0), 3 * ((x + 0.5) / 2 - 0.5), most) << x;
    for (int y = 2; y < kOutput.height - 2; ++y)
        ASSERT_NEAR(got.at(50, y, 1), 4 * ((y + 0.5) / 2 - 0.5), most) << y;
}

TEST_P(ScaledLayer, AtEdgesOfTheLayerPixelsWithoutASurfaceDoNotChangeTheVisibility) {
    constexpr Size kQuarter{40, 30};
    for (const double nothing : {0.0, kNan, -1.0}) {
        LaidLayer layer{kQuarter};
        layer.colour = [](int x, int) {
            return x == 20 ? std::array<std::uint8_t, 4>{200, 0, 0, 255}
                           : std::array<std::uint8_t, 4>{};
        };
        layer.z = [&](int x, int) { return x == 20 ? 2 : nothing; };
        layer.bounds = {20, 0, 21, kQuarter.height};
        const LaidOver got = runOverBlack(layer);
        // The centre of layer pixel 20 is at output position 81.5. Linear interpolation spreads
        // this pixel over four output pixels to each side.
        for (int x = 0; x < kOutput.width; ++x) {
            const double tent = std::max(1 - std::abs(x - 81.5) / 4, 0.0);
            ASSERT_NEAR(got.at(x, 60, 0), 200 * tent, 1.01) << x;
            ASSERT_EQ(got.visibleAt(x, 60), tent > 0 ? 1 : 0) << x;
        }
    }
}

TEST_P(ScaledLayer, LayersOfAnySizeReachTheBorders) {
    for (const Size size :
         {Size{1, 1}, Size{7, 3}, Size{53, 37}, Size{320, 240}, Size{4001, 700}}) {
        LaidLayer layer{size};
        layer.colour = [](int, int) { return std::array<std::uint8_t, 4>{100, 0, 0, 255}; };
        layer.z = [](int, int) { return 1.0; };
        layer.bounds = {0, 0, size.width, size.height};
        const LaidOver got = runOverBlack(layer);
        for (const int x : {0, 1, kOutput.width / 2, kOutput.width - 1})
            for (const int y : {0, kOutput.height - 1})
                ASSERT_EQ(got.at(x, y, 0), 100) << size.width << " at " << x << " " << y;
    }
}

}  // namespace
}  // namespace mfar
