#include "base/srgb.h"
#include "pipeline/gles/paint_textures.h"
#include "tests/engine/gl_test.h"

#include <cmath>
#include <cstdint>

namespace mfar::gles {
namespace {

using PaintTexturesGl = GlTest;

constexpr Size kPicture{8, 4};
constexpr Size kOne{1, 1};

PaintTextures painted(float metallic) {
    SurfaceTexture colour{kPicture, true, {}};
    for (int i = 0; i < kPicture.width * kPicture.height; ++i)
        colour.texels.push_back({static_cast<std::uint8_t>(7 * i), 200, 90, 255});
    return PaintTextures({&colour, nullptr, {1, 1, 1, metallic}});
}

TEST_F(PaintTexturesGl, PaintThatIsTheSameEverywhereIsStoredInOneTexel) {
    const PaintTextures dielectric = painted(0), metal = painted(1), mixed = painted(0.5F);
    EXPECT_EQ(dielectric.diffuse.size(), kPicture);
    EXPECT_EQ(dielectric.facing.size(), kOne);
    EXPECT_EQ(metal.diffuse.size(), kOne);
    EXPECT_EQ(metal.facing.size(), kPicture);
    EXPECT_EQ(mixed.diffuse.size(), kPicture);
    EXPECT_EQ(mixed.facing.size(), kPicture);
    for (const std::size_t channel : {0, 1, 2}) {
        EXPECT_EQ(metal.diffuse.readRgba8()[channel], 0);
        EXPECT_NEAR(dielectric.facing.readRgba8()[channel],
                    255 * srgbEncoded(kDielectricReflectance), 1);
        EXPECT_NEAR(dielectric.diffuse.readRgba8()[channel], metal.facing.readRgba8()[channel], 1);
    }
}

}  // namespace
}  // namespace mfar::gles
