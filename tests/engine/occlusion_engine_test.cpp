#include "pipeline/gles/layer_composite.h"
#include "pipeline/simd/occlusion_step.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <cmath>
#include <cstdlib>

namespace mfar {
namespace {

using gpu::TexelFormat;

constexpr Size kVideoSize{160, 120}, kOutputSize{576, 432};

struct EngineScene {
    explicit EngineScene(Size layer)
        : layerSize(layer), colour(layer), z(static_cast<std::size_t>(layer.width) * layer.height),
          depth(kVideoSize) {
        const Waves waves(3, 5, 60, 40);
        const double step = static_cast<double>(kVideoSize.width) / kOutputSize.width;
        video = waves.shoot(kVideoSize, {});
        picture = waves.shoot(kOutputSize, {.step = step, .footprint = step});
        for (int y = 0; y < layer.height; ++y)
            for (int x = 0; x < layer.width; ++x) {
                const double u = (x + 0.5) / layer.width - 0.5, v = (y + 0.5) / layer.height - 0.5;
                const bool is = std::hypot(u, v) < 0.4;
                const std::uint8_t texel[]{static_cast<std::uint8_t>(is ? 200 : 0),
                                           static_cast<std::uint8_t>(is ? 100 + 80 * u : 0), 0,
                                           static_cast<std::uint8_t>(is ? 230 : 0)};
                std::copy_n(texel, 4, colour.at(x, y));
                z[static_cast<std::size_t>(y) * layer.width + x] =
                    is ? static_cast<float>(1.5 + u) : 0.0F;
            }
        for (int y = 0; y < kVideoSize.height; ++y)
            for (int x = 0; x < kVideoSize.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * kVideoSize.width + x;
                const bool isNear = x + 9 * std::sin(0.3 * y) < 85;
                depth.inverseDepth[i] = isNear ? 0.8F : 0.4F;
                if (i % 13 != 0) depth.variance[i] = 0.0004F;
            }
    }
    [[nodiscard]] PixelRect bounds() const { return {0, 0, layerSize.width, layerSize.height}; }

    Size layerSize;
    TestPicture video, picture, colour;
    std::vector<float> z;
    InverseDepthField depth;
};

struct Shown {
    std::vector<std::uint8_t> picture, visibility;  // picture: RGBA8; visibility: a byte per pixel
};

Shown onGpu(const EngineScene& s) {
    const gpu::Texture colour = uploaded(s.colour, gpu::Filter::Linear);
    gpu::Texture z(s.layerSize, TexelFormat::R32F), real(kVideoSize, TexelFormat::Rg32F);
    z.upload(s.z);
    std::vector<float> samples;
    for (std::size_t i = 0; i < s.depth.inverseDepth.size(); ++i)
        samples.insert(samples.end(), {s.depth.inverseDepth[i], std::sqrt(s.depth.variance[i])});
    real.upload(samples);
    const gpu::Texture video = uploaded(s.video), picture = uploaded(s.picture);
    const gpu::Framebuffer target(picture);
    LayerComposite composite(kVideoSize, kOutputSize, s.layerSize);
    composite.run({&colour, &z, s.bounds()}, real, video, picture, target);
    Shown out{picture.readRgba8(), {}};
    const auto shares = composite.visibility().readRgba8();
    for (std::size_t i = 0; i < shares.size(); i += 4)
        out.visibility.push_back(shares[i]);
    return out;
}

Shown onHost(const EngineScene& s) {
    Shown out{s.picture.bytes, {}};
    const int width = s.layerSize.width;
    simd::OcclusionStep step(kVideoSize, kOutputSize, s.layerSize, {}, nullptr);
    step.run(
        {{reinterpret_cast<const std::uint32_t*>(s.colour.bytes.data()), width, s.layerSize},
         {s.z.data(), width, s.layerSize},
         s.bounds()},
        simd::RealDepth::of(s.depth), planesOf(s.video),
        {reinterpret_cast<std::uint32_t*>(out.picture.data()), kOutputSize.width, kOutputSize});
    for (int y = 0; y < kOutputSize.height; ++y)
        out.visibility.insert(out.visibility.end(), step.visibility()[y],
                              step.visibility()[y] + kOutputSize.width);
    return out;
}

class OcclusionEngines : public GlTest, public testing::WithParamInterface<Size> {};

TEST_P(OcclusionEngines, BothEnginesShowALayerAlike) {
    const EngineScene scene(GetParam());
    const Shown gpu = onGpu(scene), host = onHost(scene);
    double both = 0, either = 0, open = 0;
    for (std::size_t i = 0; i < gpu.visibility.size(); ++i) {
        ASSERT_NEAR(host.visibility[i], gpu.visibility[i], 2) << i;
        for (std::size_t c = 0; c < 4; ++c)
            ASSERT_NEAR(host.picture[4 * i + c], gpu.picture[4 * i + c], 2) << i;
        both += std::min(host.visibility[i], gpu.visibility[i]);
        either += std::max(host.visibility[i], gpu.visibility[i]);
        open += gpu.visibility[i] > 0 && gpu.visibility[i] < 255 ? 1 : 0;
    }
    EXPECT_GT(both / either, 0.998);
    EXPECT_GT(open, 1000);
}

INSTANTIATE_TEST_SUITE_P(Layers, OcclusionEngines,
                         testing::Values(kOutputSize, Size{288, 216}, Size{191, 133}));

}  // namespace
}  // namespace mfar
