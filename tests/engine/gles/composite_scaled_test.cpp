#include "pipeline/gles/layer_composite.h"
#include "tests/engine/gl_test.h"

#include <cmath>

namespace mfar {
namespace {

using gpu::TexelFormat;

constexpr Size kVideoOf{40, 30};
constexpr Size kOutputOf{160, 120};

/// A layer smaller than the output, over black, with nothing real that hides it.
class ScaledLayerTest : public GlTest {
protected:
    struct Texel {
        std::array<std::uint8_t, 4> colour;
        float z;
    };

    template <class F>
    void run(Size layerSize, F texelAt, const PixelRect& bounds) {
        gpu::Texture colour(layerSize, TexelFormat::Rgba8, gpu::Filter::Linear);
        gpu::Texture depth(layerSize, TexelFormat::R32F);
        gpu::Texture real(kVideoOf, TexelFormat::Rg32F), video(kVideoOf, TexelFormat::Rgba8);
        TestPicture p(layerSize);
        std::vector<float> z;
        for (int y = 0; y < layerSize.height; ++y) {
            for (int x = 0; x < layerSize.width; ++x) {
                const Texel t = texelAt(x, y);
                std::copy_n(t.colour.data(), 4, p.at(x, y));
                z.push_back(t.z);
            }
        }
        colour.upload(PlaneView{p.view().data, p.view().stride});
        depth.upload(z);
        const gpu::Texture picture = uploaded(TestPicture(kOutputOf, PixelFormat::Rgba8, 0));
        const gpu::Framebuffer target(picture);
        LayerComposite composite(kVideoOf, kOutputOf, layerSize);
        composite.run({&colour, &depth, bounds}, real, video, picture, target);
        shown_ = picture.readRgba8();
        visibility_ = composite.visibility().readRgba8();
    }
    [[nodiscard]] int red(int x, int y) const { return shown_[at(x, y)]; }
    [[nodiscard]] int visible(int x, int y) const { return visibility_[at(x, y)]; }

private:
    static std::size_t at(int x, int y) { return 4 * (1UL * y * kOutputOf.width + x); }
    std::vector<std::uint8_t> shown_, visibility_;
};

TEST_F(ScaledLayerTest, ColoursAreLinearBetweenItsPixels) {
    constexpr Size kHalf{80, 60};
    run(kHalf, [](int x, int) { return Texel{{static_cast<std::uint8_t>(3 * x), 0, 0, 255}, 2}; },
        {0, 0, kHalf.width, kHalf.height});
    for (int x = 2; x < kOutputOf.width - 2; ++x)
        ASSERT_NEAR(red(x, 50), 3 * ((x + 0.5) / 2 - 0.5), 1.01) << x;
}

TEST_F(ScaledLayerTest, EdgeTakesDepthOfThePixelThatHasOne) {
    constexpr Size kQuarter{40, 30};
    run(kQuarter,
        [](int x, int) { return x == 20 ? Texel{{200, 0, 0, 255}, 2} : Texel{{0, 0, 0, 0}, 0}; },
        {20, 0, 21, kQuarter.height});
    // Pixel 20 is centred at output 81.5; its tent reaches four output pixels to both sides.
    for (int x = 0; x < kOutputOf.width; ++x) {
        const double tent = std::max(1 - std::abs(x - 81.5) / 4, 0.0);
        ASSERT_NEAR(red(x, 60), 200 * tent, 1.01) << x;
        ASSERT_EQ(visible(x, 60), tent > 0 ? 255 : 0) << x;
    }
}

TEST_F(ScaledLayerTest, LayersOfAnySizeReachTheBorders) {
    for (const Size size : {Size{1, 1}, Size{7, 3}, Size{53, 37}, Size{320, 240}}) {
        run(size, [](int, int) { return Texel{{100, 0, 0, 255}, 1}; },
            {0, 0, size.width, size.height});
        for (const int x : {0, 1, kOutputOf.width / 2, kOutputOf.width - 1})
            for (const int y : {0, kOutputOf.height - 1})
                ASSERT_EQ(red(x, y), 100) << size.width << " at " << x << " " << y;
    }
}

}  // namespace
}  // namespace mfar
