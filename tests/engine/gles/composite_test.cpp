#include "pipeline/gles/layer_composite.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/samples_passed.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/visibility.h"

#include <functional>
#include <limits>
#include <numbers>

namespace mfar {
namespace {

using gpu::TexelFormat;

constexpr Size kCoarse{53, 37};
constexpr Size kFine{191, 133};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRounded = 0.51 / 255;

struct Virtual {
    std::array<std::uint8_t, 4> colour{200, 100, 50, 255};
    std::function<double(int, int)> z = [](int, int) { return 2.0; };
    PixelRect bounds{0, 0, kFine.width, kFine.height};
};

/// The composite of a small scene, and what came of it.
class CompositeTest : public GlTest {
protected:
    static twin::Scene plainScene(const twin::RealSample& real) {
        return {randomPicture(kCoarse, 1), randomPicture(kFine, 2),
                std::vector<twin::RealSample>(1UL * kCoarse.width * kCoarse.height, real)};
    }

    void run(const twin::Scene& scene, const Virtual& layer, const CompositeOptions& options = {}) {
        gpu::Texture colour(kFine, TexelFormat::Rgba8), depth(kFine, TexelFormat::R32F);
        gpu::Texture real(kCoarse, TexelFormat::Rg32F);
        TestPicture p(kFine);
        for (std::size_t i = 0; i < p.bytes.size(); ++i)
            p.bytes[i] = layer.colour[i % 4];
        colour.upload(PlaneView{p.view().data, p.view().stride});
        std::vector<float> z, samples;
        for (int y = 0; y < kFine.height; ++y)
            for (int x = 0; x < kFine.width; ++x)
                z.push_back(static_cast<float>(layer.z(x, y)));
        for (const twin::RealSample& s : scene.real)
            samples.insert(samples.end(), {static_cast<float>(s.rho), static_cast<float>(s.sigma)});
        depth.upload(z);
        real.upload(samples);
        const gpu::Texture video = uploaded(scene.video), picture = uploaded(scene.picture);
        const gpu::Framebuffer target(picture);
        LayerComposite composite(kCoarse, kFine, options);
        drew_ = drewAnything(
            [&] { composite.run({&colour, &depth, layer.bounds}, real, video, picture, target); });
        shown_ = picture.readRgba8();
        visibility_ = composite.visibility().readRgba8();
    }
    [[nodiscard]] double visibleAt(int x, int y) const {
        return visibility_[4UL * (1UL * y * kFine.width + x)] / 255.0;
    }
    /// The same everywhere, or -1.
    [[nodiscard]] double visibleEverywhere() const {
        for (std::size_t i = 0; i < visibility_.size(); i += 4)
            if (visibility_[i] != visibility_[0]) return -1;
        return visibility_[0] / 255.0;
    }

    bool drew_ = false;
    std::vector<std::uint8_t> shown_, visibility_;
};

TEST_F(CompositeTest, VisibilityMatchesTwin) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> rho(0.3, 0.7), sigma(0.002, 0.05), unit(0, 1);
    twin::Scene scene = plainScene({1, 1});
    const Waves waves(3, 6, 50, 40);
    scene.video = waves.shoot(kCoarse, {});
    scene.picture = waves.shoot(kFine, {.step = 53.0 / 191, .footprint = 53.0 / 191});
    for (twin::RealSample& s : scene.real) {
        s = {rho(random), sigma(random)};
        if (unit(random) < 0.1) s.rho = kNan;
        if (unit(random) < 0.1) s.sigma = 0;
    }
    Virtual layer;
    layer.z = [](int x, int y) { return 2 + 0.6 * std::sin(0.05 * x) * std::cos(0.04 * y); };
    for (const CompositeOptions& o :
         {CompositeOptions{}, CompositeOptions{.bias = 0, .softness = 5, .virtualSigma = 0.02},
          CompositeOptions{.bias = 1, .softness = 0.5, .virtualSigma = 0, .likeness = 60}}) {
        run(scene, layer, o);
        for (int y = 0; y < kFine.height; ++y)
            for (int x = 0; x < kFine.width; ++x)
                ASSERT_NEAR(visibleAt(x, y), scene.visibility(x, y, layer.z(x, y), o),
                            kRounded + 1e-3)
                    << x << " " << y;
    }
}

TEST_F(CompositeTest, EarlyAnswersAreThoseOfTheWeights) {
    // A real step, so that most pixels need no weighing, and all answers occur.
    twin::Scene scene = plainScene({0.4, 0.01});
    for (std::size_t i = 0; i < scene.real.size(); ++i)
        if (i % kCoarse.width > 20) scene.real[i].rho = 0.8;
    Virtual layer;
    layer.z = [](int, int y) { return 1.2 + 0.01 * y; };
    run(scene, layer);
    int hidden = 0, visible = 0;
    for (int y = 0; y < kFine.height; ++y)
        for (int x = 0; x < kFine.width; ++x) {
            ASSERT_NEAR(visibleAt(x, y), scene.visibility(x, y, layer.z(x, y), {}),
                        kRounded + 1e-3);
            hidden += visibleAt(x, y) == 0 ? 1 : 0;
            visible += visibleAt(x, y) == 1 ? 1 : 0;
        }
    EXPECT_GT(hidden, 4000);
    EXPECT_GT(visible, 4000);
}

TEST_F(CompositeTest, UnknownDepthNeverHides) {
    for (const double bad : {0.0, -0.0, -1.0, -1e30, 1e-42, kNan, kInfinite, -kInfinite}) {
        run(plainScene({bad, 0.01}), {});
        EXPECT_EQ(visibleEverywhere(), 1) << "inverse depth " << bad;
    }
    for (const double bad : {0.0, -0.0, -1.0, kNan, kInfinite, -kInfinite}) {
        run(plainScene({100, bad}), {});
        EXPECT_EQ(visibleEverywhere(), 1) << "sigma " << bad;
    }
}

TEST_F(CompositeTest, UnknownNeighboursOnlyShowMore) {
    twin::Scene scene = plainScene({1, 0.01});
    for (std::size_t i = 0; i < scene.real.size(); i += 3)
        scene.real[i].rho = kNan;
    run(scene, {});
    for (int y = 0; y < kFine.height; ++y)
        for (int x = 0; x < kFine.width; ++x)
            ASSERT_NEAR(visibleAt(x, y), scene.visibility(x, y, 2, {}), kRounded + 1e-3);
}

TEST_F(CompositeTest, ExtremeKnownValuesAreCompared) {
    struct Case {
        twin::RealSample real;
        double z, visible;
    };
    for (const Case& c :
         {Case{{1e5, 1e-19}, 2, 0}, Case{{2e-6, 1e-19}, 2, 1}, Case{{1e5, 9e5}, 2, 1},
          Case{{1e-5, 1e-12}, 9e5, 0}, Case{{9e5, 1}, 2e-4, 0}, Case{{0.5, 1e-19}, 2, 1}}) {
        run(plainScene(c.real), {.z = [&](int, int) { return c.z; }});
        EXPECT_EQ(visibleEverywhere(), c.visible) << c.real.rho << " " << c.real.sigma;
        run(plainScene(c.real), {.z = [&](int, int) { return c.z; }}, {.virtualSigma = 0});
        EXPECT_EQ(visibleEverywhere(), c.visible) << c.real.rho << " " << c.real.sigma;
    }
}

TEST_F(CompositeTest, LayerWithoutDepthIsNotDrawn) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const double bad : {0.0, -0.0, -2.0, 1e-42, kNan, kInfinite, -kInfinite}) {
        run(scene, {.z = [&](int, int) { return bad; }});
        EXPECT_EQ(shown_, scene.picture.bytes) << bad;
    }
}

TEST_F(CompositeTest, VirtualThingWinsWhereBothAreEqual) {
    constexpr double kSigma = 0.01;
    const CompositeOptions o{.bias = 2, .softness = 2, .virtualSigma = 0};
    for (const auto& [sigmas, visible] :
         {std::pair{-50.0, 1.0}, {0.0, 1.0}, {1.9, 1.0}, {3.0, 0.5}, {4.1, 0.0}, {50.0, 0.0}}) {
        run(plainScene({0.5 + sigmas * kSigma, kSigma}), {}, o);
        EXPECT_NEAR(visibleAt(90, 60), visible, 0.01) << sigmas;
    }
}

TEST_F(CompositeTest, BlendIsOverByVisibility) {
    const twin::Scene scene = plainScene({0.53, 0.01});
    const Virtual layer{.colour = {120, 60, 0, 128}, .bounds = {30, 20, 131, 103}};
    run(scene, layer, {.bias = 2, .softness = 2, .virtualSigma = 0});
    EXPECT_NEAR(visibleAt(90, 60), 0.5, 0.01);
    for (int y = 0; y < kFine.height; ++y)
        for (int x = 0; x < kFine.width; ++x) {
            const PixelRect& b = layer.bounds;
            const bool in = x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1;
            const double v = in ? visibleAt(x, y) : 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t i = 4 * (1UL * y * kFine.width + x) + c;
                const double wanted =
                    v * layer.colour[c] + (1 - v * layer.colour[3] / 255) * scene.picture.bytes[i];
                ASSERT_NEAR(shown_[i], wanted, in ? 1.1 : 0) << x << " " << y;
            }
        }
}

TEST_F(CompositeTest, BoundsAreClippedAtTheBorders) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const PixelRect& b : {PixelRect{-50, -9, 1000, 999}, PixelRect{180, 120, 500, 140}}) {
        run(scene, {.bounds = b});
        for (int y = std::max(b.y0, 0); y < kFine.height; ++y)
            for (int x = std::max(b.x0, 0); x < kFine.width; ++x)
                ASSERT_EQ(shown_[4UL * (1UL * y * kFine.width + x)], 200);
    }
}

TEST_F(CompositeTest, EmptyBoundsDrawNothing) {
    const twin::Scene scene = plainScene({0.1, 0.01});
    for (const PixelRect& b : {PixelRect{}, PixelRect{9, 9, 9, 20}, PixelRect{-20, 0, -1, 30},
                               PixelRect{191, 0, 300, 30}, PixelRect{50, 50, 20, 60}}) {
        run(scene, {.bounds = b});
        EXPECT_FALSE(drew_);
        EXPECT_EQ(shown_, scene.picture.bytes);
    }
    run(scene, {.bounds = {9, 9, 10, 10}});
    EXPECT_TRUE(drew_);
}

TEST_F(CompositeTest, OptionsOutOfRangeAreRefused) {
    for (const double bad : {-1.0, 1e9, kNan, kInfinite}) {
        EXPECT_THROW(LayerComposite(kCoarse, kFine, {.bias = bad}), std::invalid_argument);
        EXPECT_THROW(LayerComposite(kCoarse, kFine, {.virtualSigma = bad}), std::invalid_argument);
    }
    for (const double bad : {0.0, -1.0, 1e9, kNan}) {
        EXPECT_THROW(LayerComposite(kCoarse, kFine, {.softness = bad}), std::invalid_argument);
        EXPECT_THROW(LayerComposite(kCoarse, kFine, {.likeness = bad}), std::invalid_argument);
    }
}

/// A near thing to the left of a straight edge. The edge runs through (26.3, 18) at an angle.
struct EdgeScene {
    double degrees;
    double contrast = 90;  ///< [grey levels]

    /// Signed distance to the right of the edge, position and result in video px.
    [[nodiscard]] double beyond(double u, double v) const {
        const double a = degrees * std::numbers::pi / 180;
        return (u - 26.3) * std::cos(a) + (v - 18) * std::sin(a);
    }
    [[nodiscard]] TestPicture shoot(Size size) const {
        TestPicture p(size, PixelFormat::Rgba8, 255);
        const double step = static_cast<double>(kCoarse.width) / size.width;
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
        twin::Scene s{shoot(kCoarse), shoot(kFine), {}};
        for (int y = 0; y < kCoarse.height; ++y)
            for (int x = 0; x < kCoarse.width; ++x)
                s.real.push_back({beyond(x, y) < 0 ? 1.0 : 0.25, 0.01});
        return s;
    }
};

class CompositeEdge : public CompositeTest {
protected:
    /// Mean distance of visibility's half from the edge [video px]: the area between both, over
    /// the length of the edge.
    double boundaryError(const EdgeScene& edge) {
        run(edge.scene(), {});
        const double step = static_cast<double>(kCoarse.width) / kFine.width;
        double wrong = 0;
        int rows = 0;
        for (int y = 12; y < kFine.height - 12; ++y, ++rows)
            for (int x = 0; x < kFine.width; ++x) {
                const double d = edge.beyond((x + 0.5) * step - 0.5, (y + 0.5) * step - 0.5);
                if ((visibleAt(x, y) > 0.5) != (d > 0)) wrong += step * step;
            }
        return wrong * std::cos(edge.degrees * std::numbers::pi / 180) / (rows * step);
    }
};

TEST_F(CompositeEdge, HalfHiddenThingEndsAtTheImageEdge) {
    for (const double degrees : {0.0, 7.0, -20.0, 38.0}) {
        EXPECT_LE(boundaryError({degrees}), 0.08) << degrees;
        EXPECT_LE(boundaryError({.degrees = degrees, .contrast = 0}), 0.3) << degrees;
    }
}

}  // namespace
}  // namespace mfar
