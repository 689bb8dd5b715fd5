#include "pipeline/render/exposure.h"
#include "pipeline/render/texture_lookup.h"

#include <gtest/gtest.h>

namespace mfar {
namespace {

SurfaceTexture twoByTwo(bool srgb) {
    SurfaceTexture out;
    out.size = {2, 2};
    out.srgb = srgb;
    out.texels = {{0, 0, 0, 255}, {255, 0, 0, 255}, {0, 255, 0, 0}, {255, 255, 128, 255}};
    return out;
}

TEST(TextureLookup, TexelCentresGiveTheTexelsValues) {
    const SurfaceTexture texture = twoByTwo(false);
    EXPECT_TRUE(lookUp(texture, {0.75F, 0.25F}).isApprox(Eigen::Vector4f(1, 0, 0, 1)));
    EXPECT_TRUE(lookUp(texture, {0.25F, 0.75F}).isApprox(Eigen::Vector4f(0, 1, 0, 0)));
}

TEST(TextureLookup, InterpolatesTexelsAndRepeatsTheTexture) {
    const SurfaceTexture texture = twoByTwo(false);
    EXPECT_NEAR(lookUp(texture, {0.5F, 0.25F}).x(), 0.5F, 1e-6F);
    EXPECT_NEAR(lookUp(texture, {0, 0.25F}).x(), 0.5F, 1e-6F);
    EXPECT_TRUE(lookUp(texture, {-7.25F, 12.25F}).isApprox(lookUp(texture, {0.75F, 0.25F})));
    EXPECT_TRUE(lookUp(texture, {1e30F, -1e30F}).allFinite());
}

TEST(TextureLookup, DecodesColoursButNotAlpha) {
    const SurfaceTexture texture = twoByTwo(true);
    EXPECT_NEAR(lookUp(texture, {0.75F, 0.75F}).z(), srgbDecoded(128 / 255.0F), 1e-6F);
    EXPECT_NEAR(lookUp(texture, {0.25F, 0.5F}).w(), 0.5F, 1e-6F);
}

}  // namespace
}  // namespace mfar
