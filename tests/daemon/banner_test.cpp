#include "daemon/banner.h"
#include "tests/shader/gl_test.h"

#include <algorithm>
#include <vector>

namespace mfar {
namespace {

constexpr Size kPictureSize{320, 240};

using BannerText = GlTest;

std::vector<std::uint8_t> pixelsOf(const GlImage& image) {
    std::vector<std::uint8_t> out(std::size_t{4} * image.size.width * image.size.height);
    GLuint target = 0;
    glGenFramebuffers(1, &target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image.texture, 0);
    glReadPixels(0, 0, image.size.width, image.size.height, GL_RGBA, GL_UNSIGNED_BYTE, out.data());
    glDeleteFramebuffers(1, &target);
    return out;
}

gpu::Texture plainPicture(std::uint8_t level) {
    gpu::Texture out(kPictureSize, gpu::TexelFormat::Rgba8);
    const std::vector<std::uint8_t> pixels(
        std::size_t{4} * kPictureSize.width * kPictureSize.height, level);
    out.upload({pixels.data(), std::size_t{4} * kPictureSize.width});
    return out;
}

/// First row that is not all of this level; the height where there is none.
int rowsOf(const std::vector<std::uint8_t>& pixels, std::uint8_t level) {
    const std::size_t row = std::size_t{4} * kPictureSize.width;
    for (std::size_t y = 0; y < pixels.size() / row; ++y)
        for (std::size_t i = 0; i < row; ++i)
            if (i % 4 != 3 && pixels[y * row + i] != level) return static_cast<int>(y);
    return kPictureSize.height;
}

TEST_F(BannerText, StandsBelowThePictureAndLeavesItAlone) {
    Banner banner(kPictureSize);
    const gpu::Texture picture = plainPicture(90);
    const GlImage source{picture.id(), kPictureSize};
    const auto shown = pixelsOf(banner.over(source, "the camera has gone"));
    EXPECT_GE(rowsOf(shown, 90), 200);
    EXPECT_LT(rowsOf(shown, 90), 235);
    EXPECT_EQ(rowsOf(pixelsOf(source), 90), kPictureSize.height);
}

TEST_F(BannerText, TextsDifferAndLongOnesTakeMoreLines) {
    Banner banner(kPictureSize);
    const gpu::Texture picture = plainPicture(90);
    const GlImage source{picture.id(), kPictureSize};
    const auto first = pixelsOf(banner.over(source, "one"));
    const auto second = pixelsOf(banner.over(source, "two"));
    EXPECT_NE(first, second);
    EXPECT_EQ(first, pixelsOf(banner.over(source, "one")));
    const auto longer = pixelsOf(banner.over(
        source, "video camera: there is no such camera, only these: \nand a second line of words"));
    EXPECT_LT(rowsOf(longer, 90), rowsOf(first, 90));
    const std::string endless(5000, 'x');
    EXPECT_GT(rowsOf(pixelsOf(banner.over(source, endless + " " + endless)), 90), 120);
}

TEST_F(BannerText, WithoutAPictureItIsBlack) {
    Banner banner(kPictureSize);
    const auto shown = pixelsOf(banner.over({}, "no picture yet"));
    EXPECT_GE(rowsOf(shown, 0), 200);
    EXPECT_LT(rowsOf(shown, 0), 235);
}

}  // namespace
}  // namespace mfar
