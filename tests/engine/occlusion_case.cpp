#include "tests/engine/occlusion_case.h"

#include "pipeline/gles/layer_composite.h"
#include "pipeline/simd/occlusion_step.h"
#include "tests/engine/pictures.h"

#include <cstring>
#include <memory>

namespace mfar {
namespace {

struct LayerPixels {
    explicit LayerPixels(const LaidLayer& layer) : colour(layer.size) {
        for (int y = 0; y < layer.size.height; ++y)
            for (int x = 0; x < layer.size.width; ++x) {
                const std::array<std::uint8_t, 4> texel = layer.colour(x, y);
                std::copy_n(texel.data(), 4, colour.at(x, y));
                z.push_back(static_cast<float>(layer.z(x, y)));
            }
    }
    TestPicture colour;
    std::vector<float> z;
};

LaidOver byShaders(const twin::Scene& scene, const LaidLayer& layer,
                   const CompositeOptions& options) {
    const Size video = scene.video.size, output = scene.picture.size;
    LayerPixels pixels(layer);
    gpu::Texture colour(layer.size, gpu::TexelFormat::Rgba8, gpu::Filter::Linear);
    gpu::Texture depth(layer.size, gpu::TexelFormat::R32F);
    gpu::Texture real(video, gpu::TexelFormat::Rg32F);
    std::vector<float> samples;
    for (const twin::RealSample& s : scene.real)
        samples.insert(samples.end(),
                       {static_cast<float>(s.inverseDepth), static_cast<float>(s.sigma)});
    colour.upload(PlaneView{pixels.colour.view().data, pixels.colour.view().stride});
    depth.upload(pixels.z);
    real.upload(samples);
    const gpu::Texture frame = uploaded(scene.video), picture = uploaded(scene.picture);
    const gpu::Framebuffer target(picture);
    LayerComposite composite(video, output, layer.size, options);
    composite.run({&colour, &depth, layer.bounds}, real, frame, picture, target);
    LaidOver out{output, picture.readRgba8(), {}};
    const auto visibility = composite.visibility().readRgba8();
    for (std::size_t i = 0; i < visibility.size(); i += 4)
        out.visibility.push_back(visibility[i]);
    return out;
}

LaidOver byKernels(const twin::Scene& scene, const LaidLayer& layer,
                   const CompositeOptions& options) {
    const Size video = scene.video.size, output = scene.picture.size;
    LayerPixels pixels(layer);
    AlignedRows<float> inverseDepth(video), sigma(video), z(layer.size);
    AlignedRows<std::uint32_t> colour(layer.size);
    for (int y = 0, i = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x, ++i) {
            inverseDepth[y][x] = static_cast<float>(scene.real[i].inverseDepth);
            sigma[y][x] = static_cast<float>(scene.real[i].sigma);
        }
    for (int y = 0; y < layer.size.height; ++y) {
        std::memcpy(colour[y], pixels.colour.at(0, y), 4UL * layer.size.width);
        std::copy_n(&pixels.z[static_cast<std::size_t>(y) * layer.size.width], layer.size.width,
                    z[y]);
    }
    AlignedRows<std::uint32_t> picture(output);
    for (int y = 0; y < output.height; ++y)
        std::memcpy(picture[y], &scene.picture.bytes[4UL * y * output.width], 4UL * output.width);
    const RgbPlanes planes = planesOf(scene.video);
    simd::OcclusionStep step(video, output, layer.size, options, std::make_shared<Workers>(2));
    step.run({colour.rows(), z.rows(), layer.bounds}, {inverseDepth.rows(), sigma.rows()}, planes,
             picture.rows());
    LaidOver out{output, {}, {}};
    for (int y = 0; y < output.height; ++y) {
        const auto* row = reinterpret_cast<const std::uint8_t*>(picture[y]);
        out.shown.insert(out.shown.end(), row, row + 4UL * output.width);
        out.visibility.insert(out.visibility.end(), step.visibility()[y],
                              step.visibility()[y] + output.width);
    }
    return out;
}

}  // namespace

twin::Scene OcclusionCase::plainScene(const twin::RealSample& real) {
    return {randomPicture(kCoarse, 1), randomPicture(kFine, 2),
            std::vector<twin::RealSample>(1UL * kCoarse.width * kCoarse.height, real)};
}

LaidOver OcclusionCase::laidOver(EngineKind engine, const twin::Scene& scene,
                                 const LaidLayer& layer, const CompositeOptions& options) {
    LaidLayer sized = layer;
    if (sized.size.width == 0) sized.size = scene.picture.size;
    return engine == EngineKind::Gles ? byShaders(scene, sized, options)
                                      : byKernels(scene, sized, options);
}

void expectOracles(const LaidOver& got, twin::Scene scene, const LaidLayer& layer,
                   const CompositeOptions& options) {
    constexpr double kRounded = 0.51 / 255;
    for (int y = 0; y < got.output.height; ++y)
        for (int x = 0; x < got.output.width; ++x)
            ASSERT_NEAR(got.visibleAt(x, y), scene.visibility(x, y, layer.z(x, y), options),
                        kRounded + 1e-3)
                << x << " " << y;
}

}  // namespace mfar
