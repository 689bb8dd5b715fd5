#include "pipeline/gles/layer_composite.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/samples_passed.h"
#include "tests/engine/pictures.h"

namespace mfar {
namespace {

using CompositeTest = GlTest;

bool drawsWithin(const PixelRect& bounds) {
    constexpr Size kCoarse{53, 37}, kFine{191, 133};
    const gpu::Texture colour = uploaded(TestPicture(kFine, PixelFormat::Rgba8, 255));
    gpu::Texture depth(kFine, gpu::TexelFormat::R32F);
    depth.upload(std::vector<float>(1UL * kFine.width * kFine.height, 2.0F));
    const gpu::Texture real(kCoarse, gpu::TexelFormat::Rg32F);
    const gpu::Texture video = uploaded(randomPicture(kCoarse, 1));
    const gpu::Texture picture = uploaded(randomPicture(kFine, 2));
    const gpu::Framebuffer target(picture);
    LayerComposite composite(kCoarse, kFine);
    return drewAnything(
        [&] { composite.run({&colour, &depth, bounds}, real, video, picture, target); });
}

TEST_F(CompositeTest, LayersWithEmptyBoundsDrawNothing) {
    for (const PixelRect& b : {PixelRect{}, PixelRect{9, 9, 9, 20}, PixelRect{-20, 0, -1, 30},
                               PixelRect{191, 0, 300, 30}, PixelRect{50, 50, 20, 60}})
        EXPECT_FALSE(drawsWithin(b));
    EXPECT_TRUE(drawsWithin({9, 9, 10, 10}));
}

}  // namespace
}  // namespace mfar
