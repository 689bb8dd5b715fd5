#include "pipeline/simd/occlusion_step.h"
#include "tests/oracle/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

namespace mfar::simd {
namespace {

constexpr Size kCoarse{53, 37};
constexpr Size kFine{191, 133};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounded = 0.51 / 255;

/// Smooth waves, seen alike at any size.
TestPicture wavyPicture(Size size) {
    TestPicture out(size, PixelFormat::Rgba8, 255);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double u = (x + 0.5) * kCoarse.width / size.width;
            const double v = (y + 0.5) * kCoarse.height / size.height;
            for (int c = 0; c < 3; ++c)
                out.at(x, y)[c] = static_cast<std::uint8_t>(
                    128 + 60 * std::sin(0.8 * u + c) * std::cos(0.6 * v - c) +
                    30 * std::sin(0.1 * u * v));
        }
    return out;
}

TestPicture noisyPicture(Size size, unsigned seed) {
    TestPicture out(size);
    std::mt19937 random(seed);
    for (auto& b : out.bytes)
        b = static_cast<std::uint8_t>(random() >> 24);
    return out;
}

struct Layer {
    std::array<std::uint8_t, 4> colour{200, 100, 50, 255};
    std::function<double(int, int)> z = [](int, int) { return 2.0; };
    PixelRect bounds{0, 0, 1000, 1000};
};

/// A frame with a layer over it, and what comes of it.
class Occlusion {
public:
    Occlusion(Size video, Size output) : video_(video), output_(output) {}

    [[nodiscard]] twin::Scene plainScene(const twin::RealSample& real) const {
        return {noisyPicture(video_, 1), noisyPicture(output_, 2),
                std::vector<twin::RealSample>(1UL * video_.width * video_.height, real)};
    }
    void run(const twin::Scene& scene, const Layer& layer, const CompositeOptions& options = {},
             int threads = 0, bool squared = false) {
        AlignedRows<float> rho(video_), sigma(video_), z(output_);
        AlignedRows<std::uint32_t> colour(output_);
        for (int y = 0; y < video_.height; ++y)
            for (int x = 0; x < video_.width; ++x) {
                const twin::RealSample& s = scene.real[1UL * y * video_.width + x];
                rho[y][x] = static_cast<float>(s.rho);
                sigma[y][x] = static_cast<float>(squared ? s.sigma * s.sigma : s.sigma);
            }
        for (int y = 0; y < output_.height; ++y)
            for (int x = 0; x < output_.width; ++x) {
                z[y][x] = static_cast<float>(layer.z(x, y));
                std::memcpy(&colour[y][x], layer.colour.data(), 4);
            }
        RgbPlanes planes(video_);
        planes.take(scene.video.view());
        shown_ = scene.picture.bytes;
        OcclusionStep step(video_, output_, output_, options,
                           threads > 0 ? std::make_shared<Workers>(threads) : nullptr);
        step.run({colour.rows(), z.rows(), layer.bounds}, {rho.rows(), sigma.rows(), squared},
                 planes, {reinterpret_cast<std::uint32_t*>(shown_.data()), output_.width, output_});
        visibility_.clear();
        for (int y = 0; y < output_.height; ++y)
            visibility_.insert(visibility_.end(), step.visibility()[y],
                               step.visibility()[y] + output_.width);
    }

    [[nodiscard]] double visibleAt(int x, int y) const {
        return visibility_[1UL * y * output_.width + x] / 255.0;
    }
    /// The same everywhere, or -1.
    [[nodiscard]] double visibleEverywhere() const {
        for (const std::uint8_t share : visibility_)
            if (share != visibility_[0]) return -1;
        return visibility_[0] / 255.0;
    }
    void expectTwin(twin::Scene scene, const Layer& layer, const CompositeOptions& o = {}) const {
        for (int y = 0; y < output_.height; ++y)
            for (int x = 0; x < output_.width; ++x)
                ASSERT_NEAR(visibleAt(x, y), scene.visibility(x, y, layer.z(x, y), o),
                            kRounded + 1e-3)
                    << x << " " << y;
    }
    [[nodiscard]] const std::vector<std::uint8_t>& shown() const { return shown_; }
    [[nodiscard]] const std::vector<std::uint8_t>& visibility() const { return visibility_; }

private:
    Size video_, output_;
    std::vector<std::uint8_t> shown_, visibility_;
};

struct Sides {
    Size video, output;
};

class OcclusionSizes : public testing::TestWithParam<Sides> {
protected:
    [[nodiscard]] twin::Scene roughScene() const {
        const auto& [video, output] = GetParam();
        std::mt19937 random(5);
        std::uniform_real_distribution<double> rho(0.3, 0.7), sigma(0.002, 0.05), unit(0, 1);
        twin::Scene scene{wavyPicture(video), wavyPicture(output), {}};
        for (int i = 0; i < video.width * video.height; ++i) {
            scene.real.push_back({rho(random), sigma(random)});
            if (unit(random) < 0.1) scene.real.back().rho = kNan;
            if (unit(random) < 0.1) scene.real.back().sigma = 0;
        }
        return scene;
    }
};

TEST_P(OcclusionSizes, VisibilityMatchesTwin) {
    Layer layer;
    layer.z = [](int x, int y) { return 2 + 0.6 * std::sin(0.05 * x) * std::cos(0.04 * y); };
    const twin::Scene scene = roughScene();
    Occlusion occlusion(GetParam().video, GetParam().output);
    for (const CompositeOptions& o :
         {CompositeOptions{}, CompositeOptions{.bias = 0, .softness = 5, .virtualSigma = 0.02},
          CompositeOptions{.bias = 1, .softness = 0.5, .virtualSigma = 0, .likeness = 60}}) {
        occlusion.run(scene, layer, o);
        occlusion.expectTwin(scene, layer, o);
    }
}

TEST_P(OcclusionSizes, ThreadsAndBoundsChangeNothingInside) {
    const auto& [video, output] = GetParam();
    const twin::Scene scene = roughScene();
    Layer layer;
    layer.z = [](int x, int y) { return 2 + 0.6 * std::sin(0.05 * x) * std::cos(0.04 * y); };
    Occlusion whole(video, output), part(video, output);
    whole.run(scene, layer);
    layer.bounds = {output.width / 3, output.height / 4, output.width - 1, output.height - 3};
    for (const int threads : {0, 2, 3}) {
        part.run(scene, layer, {}, threads, threads == 2);
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x) {
                const PixelRect& b = layer.bounds;
                const bool in = x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1;
                if (in) {
                    // Squared sigmas come back from a root.
                    ASSERT_NEAR(part.visibleAt(x, y), whole.visibleAt(x, y),
                                threads == 2 ? 1.01 / 255 : 0);
                }
                for (std::size_t c = 0; c < 4; ++c) {
                    const std::size_t i = 4 * (1UL * y * output.width + x) + c;
                    ASSERT_NEAR(part.shown()[i], in ? whole.shown()[i] : scene.picture.bytes[i],
                                in && threads == 2 ? 2 : 0)
                        << x << ", " << y;
                }
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, OcclusionSizes,
                         testing::Values(Sides{kCoarse, kFine}, Sides{{16, 16}, {16, 16}},
                                         Sides{{17, 31}, {601, 40}}, Sides{{64, 48}, {33, 21}},
                                         Sides{{40, 30}, {160, 120}}));

class OcclusionTest : public testing::Test, protected Occlusion {
protected:
    OcclusionTest() : Occlusion(kCoarse, kFine) {}
};

TEST_F(OcclusionTest, EarlyAnswersAreThoseOfTheWeights) {
    twin::Scene scene = plainScene({0.4, 0.01});
    for (std::size_t i = 0; i < scene.real.size(); ++i)
        if (i % kCoarse.width > 20) scene.real[i].rho = 0.8;
    Layer layer;
    layer.z = [](int, int y) { return 1.2 + 0.01 * y; };
    run(scene, layer);
    expectTwin(scene, layer);
    EXPECT_GT(std::ranges::count(visibility(), 0), 4000);
    EXPECT_GT(std::ranges::count(visibility(), 255), 4000);
}

TEST_F(OcclusionTest, UnknownDepthNeverHides) {
    for (const double bad : {0.0, -0.0, -1.0, -1e30, 1e-42, kNan, kInfinite, -kInfinite}) {
        run(plainScene({bad, 0.01}), {});
        EXPECT_EQ(visibleEverywhere(), 1) << "inverse depth " << bad;
    }
    for (const double bad : {0.0, -0.0, -1.0, kNan, kInfinite, -kInfinite}) {
        run(plainScene({100, bad}), {});
        EXPECT_EQ(visibleEverywhere(), 1) << "sigma " << bad;
    }
}

TEST_F(OcclusionTest, UnknownNeighboursOnlyShowMore) {
    twin::Scene scene = plainScene({1, 0.01});
    for (std::size_t i = 0; i < scene.real.size(); i += 3)
        scene.real[i].rho = kNan;
    run(scene, {});
    expectTwin(scene, {});
}

TEST_F(OcclusionTest, ExtremeKnownValuesAreCompared) {
    struct Case {
        twin::RealSample real;
        double z, visible;
    };
    for (const Case& c :
         {Case{{1e5, 1e-19}, 2, 0}, Case{{2e-6, 1e-19}, 2, 1}, Case{{1e5, 9e5}, 2, 1},
          Case{{1e-5, 1e-12}, 9e5, 0}, Case{{9e5, 1}, 2e-4, 0}, Case{{0.5, 1e-19}, 2, 1}}) {
        Layer layer;
        layer.z = [&](int, int) { return c.z; };
        run(plainScene(c.real), layer);
        EXPECT_EQ(visibleEverywhere(), c.visible) << c.real.rho << " " << c.real.sigma;
        run(plainScene(c.real), layer, {.virtualSigma = 0});
        EXPECT_EQ(visibleEverywhere(), c.visible) << c.real.rho << " " << c.real.sigma;
    }
}

TEST_F(OcclusionTest, LayerWithoutDepthIsNotDrawn) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const double bad : {0.0, -0.0, -2.0, 1e-42, kNan, kInfinite, -kInfinite}) {
        Layer layer;
        layer.z = [&](int, int) { return bad; };
        run(scene, layer);
        EXPECT_EQ(shown(), scene.picture.bytes) << bad;
    }
}

TEST_F(OcclusionTest, VirtualThingWinsWhereBothAreEqual) {
    constexpr double kSigma = 0.01;
    const CompositeOptions o{.bias = 2, .softness = 2, .virtualSigma = 0};
    for (const auto& [sigmas, visible] :
         {std::pair{-50.0, 1.0}, {0.0, 1.0}, {1.9, 1.0}, {3.0, 0.5}, {4.1, 0.0}, {50.0, 0.0}}) {
        run(plainScene({0.5 + sigmas * kSigma, kSigma}), {}, o);
        EXPECT_NEAR(visibleAt(90, 60), visible, 0.01) << sigmas;
    }
}

TEST_F(OcclusionTest, BlendIsOverByVisibility) {
    const twin::Scene scene = plainScene({0.53, 0.01});
    Layer layer;
    layer.colour = {120, 60, 0, 128};
    run(scene, layer, {.bias = 2, .softness = 2, .virtualSigma = 0});
    EXPECT_NEAR(visibleAt(90, 60), 0.5, 0.01);
    for (int y = 0; y < kFine.height; ++y)
        for (int x = 0; x < kFine.width; ++x)
            for (std::size_t c = 0; c < 4; ++c) {
                const double v = visibleAt(x, y);
                const std::size_t i = 4 * (1UL * y * kFine.width + x) + c;
                const double wanted =
                    v * layer.colour[c] + (1 - v * layer.colour[3] / 255) * scene.picture.bytes[i];
                ASSERT_NEAR(shown()[i], wanted, 1.01) << x << " " << y;
            }
}

// An opaque layer replaces the picture exactly, and one that is not premultiplied cannot overflow.
TEST_F(OcclusionTest, OpaqueLayersReplaceThePicture) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const std::array<std::uint8_t, 4>& colour :
         {std::array<std::uint8_t, 4>{1, 254, 77, 255}, {255, 255, 255, 0}}) {
        Layer layer;
        layer.colour = colour;
        run(scene, layer);
        for (std::size_t i = 0; i < shown().size(); ++i)
            if (i % 4 != 3) {
                ASSERT_EQ(shown()[i], colour[3] == 0 ? 255 : colour[i % 4]);
            }
    }
}

TEST_F(OcclusionTest, BoundsAreClippedAndEmptyOnesDrawNothing) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const PixelRect& b : {PixelRect{-50, -9, 1000, 999}, PixelRect{180, 120, 500, 140}}) {
        Layer layer;
        layer.bounds = b;
        run(scene, layer);
        for (int y = std::max(b.y0, 0); y < kFine.height; ++y)
            for (int x = std::max(b.x0, 0); x < kFine.width; ++x)
                ASSERT_EQ(shown()[4UL * (1UL * y * kFine.width + x)], 200);
    }
    for (const PixelRect& b : {PixelRect{}, PixelRect{9, 9, 9, 20}, PixelRect{-20, 0, -1, 30},
                               PixelRect{191, 0, 300, 30}, PixelRect{50, 50, 20, 60}}) {
        Layer layer;
        layer.bounds = b;
        run(scene, layer);
        EXPECT_EQ(shown(), scene.picture.bytes);
    }
}

TEST(OcclusionStep, OptionsOutOfRangeAreRefused) {
    const auto make = [](const CompositeOptions& o) {
        return OcclusionStep(kCoarse, kFine, kFine, o, nullptr);
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

/// A layer of a size of its own, over black, with nothing real that hides it.
class ScaledOcclusion : public testing::Test {
protected:
    static constexpr Size kVideo{40, 30}, kOutput{160, 120};
    struct Texel {
        std::array<std::uint8_t, 4> colour;
        float z;
    };

    template <class F>
    void run(Size size, F texelAt, const PixelRect& bounds) {
        AlignedRows<std::uint32_t> colour(size);
        AlignedRows<float> z(size), unknown(kVideo);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const Texel t = texelAt(x, y);
                std::memcpy(&colour[y][x], t.colour.data(), 4);
                z[y][x] = t.z;
            }
        const RgbPlanes video(kVideo);
        picture_ = AlignedRows<std::uint32_t>(kOutput);
        OcclusionStep step(kVideo, kOutput, size, {}, nullptr);
        step.run({colour.rows(), z.rows(), bounds}, {unknown.rows(), unknown.rows()}, video,
                 picture_.rows());
        visibility_.clear();
        for (int y = 0; y < kOutput.height; ++y)
            visibility_.insert(visibility_.end(), step.visibility()[y],
                               step.visibility()[y] + kOutput.width);
    }
    [[nodiscard]] int red(int x, int y) const { return static_cast<int>(picture_[y][x] & 255U); }
    [[nodiscard]] int visible(int x, int y) const {
        return visibility_[1UL * y * kOutput.width + x];
    }

private:
    AlignedRows<std::uint32_t> picture_;
    std::vector<std::uint8_t> visibility_;
};

TEST_F(ScaledOcclusion, ColoursAreLinearBetweenItsPixels) {
    constexpr Size kHalf{80, 60};
    run(kHalf, [](int x, int) { return Texel{{static_cast<std::uint8_t>(3 * x), 0, 0, 255}, 2}; },
        {0, 0, kHalf.width, kHalf.height});
    for (int x = 2; x < kOutput.width - 2; ++x)
        ASSERT_NEAR(red(x, 50), 3 * ((x + 0.5) / 2 - 0.5), 0.53) << x;
    run(kHalf, [](int, int y) { return Texel{{static_cast<std::uint8_t>(4 * y), 0, 0, 255}, 2}; },
        {0, 0, kHalf.width, kHalf.height});
    for (int y = 2; y < kOutput.height - 2; ++y)
        ASSERT_NEAR(red(50, y), 4 * ((y + 0.5) / 2 - 0.5), 0.53) << y;
}

TEST_F(ScaledOcclusion, EdgeTakesDepthOfThePixelThatHasOne) {
    constexpr Size kQuarter{40, 30};
    for (const float nothing : {0.0F, static_cast<float>(kNan), -1.0F}) {
        run(kQuarter,
            [&](int x, int) {
                return x == 20 ? Texel{{200, 0, 0, 255}, 2} : Texel{{0, 0, 0, 0}, nothing};
            },
            {20, 0, 21, kQuarter.height});
        // Pixel 20 is centred at output 81.5; its tent reaches four output pixels to both sides.
        for (int x = 0; x < kOutput.width; ++x) {
            const double tent = std::max(1 - std::abs(x - 81.5) / 4, 0.0);
            ASSERT_NEAR(red(x, 60), 200 * tent, 1.01) << x;
            ASSERT_EQ(visible(x, 60), tent > 0 ? 255 : 0) << x;
        }
    }
}

TEST_F(ScaledOcclusion, LayersOfAnySizeReachTheBorders) {
    for (const Size size :
         {Size{1, 1}, Size{7, 3}, Size{53, 37}, Size{320, 240}, Size{4001, 700}}) {
        run(size, [](int, int) { return Texel{{100, 0, 0, 255}, 1}; },
            {0, 0, size.width, size.height});
        for (const int x : {0, 1, kOutput.width / 2, kOutput.width - 1})
            for (const int y : {0, kOutput.height - 1})
                ASSERT_EQ(red(x, y), 100) << size.width << " at " << x << " " << y;
    }
}

}  // namespace
}  // namespace mfar::simd
