#include "daemon/banner.h"
#include "tests/engine/gl_test.h"

#include <algorithm>
#include <vector>

namespace mfar {
namespace {

constexpr Size kPictureSize{320, 240};

using BannerText = GlTest;

std::vector<std::uint8_t> pixelsOf(const Picture& picture) {
    const std::size_t stride = std::size_t{4} * picture.size().width;
    std::vector<std::uint8_t> out(stride * picture.size().height);
    copyPicture(picture, out.data(), stride);
    return out;
}

gpu::Texture plainPicture(std::uint8_t level) {
    gpu::Texture out(kPictureSize, gpu::TexelFormat::Rgba8);
    const std::vector<std::uint8_t> pixels(
        std::size_t{4} * kPictureSize.width * kPictureSize.height, level);
    out.upload({pixels.data(), std::size_t{4} * kPictureSize.width});
    return out;
}

/// Returns the index of the first row in which a colour channel is not `level`; the picture's
/// height if there is no such row.
int rowsOf(const std::vector<std::uint8_t>& pixels, std::uint8_t level) {
    const std::size_t row = std::size_t{4} * kPictureSize.width;
    for (std::size_t y = 0; y < pixels.size() / row; ++y)
        for (std::size_t i = 0; i < row; ++i)
            if (i % 4 != 3 && pixels[y * row + i] != level) return static_cast<int>(y);
    return kPictureSize.height;
}

TEST_F(BannerText, IsDrawnAtTheLowerEdgeAndLeavesTheSourcePictureUnchanged) {
    Banner banner(kPictureSize);
    const gpu::Texture picture = plainPicture(90);
    const Picture source = GlImage{picture.id(), kPictureSize};
    const auto shown = pixelsOf(banner.over(source, "the camera has gone"));
    EXPECT_GE(rowsOf(shown, 90), 200);
    EXPECT_LT(rowsOf(shown, 90), 235);
    EXPECT_EQ(rowsOf(pixelsOf(source), 90), kPictureSize.height);
}

TEST_F(BannerText, DifferentTextsLookDifferentAndLongTextsTakeMoreLines) {
    Banner banner(kPictureSize);
    const gpu::Texture picture = plainPicture(90);
    const Picture source = GlImage{picture.id(), kPictureSize};
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

TEST_F(BannerText, PicturesInHostAndGpuMemoryGetTheSameBanner) {
    Banner banner(kPictureSize);
    const gpu::Texture texture = plainPicture(90);
    AlignedRows<std::uint32_t> rows(kPictureSize);
    for (int y = 0; y < kPictureSize.height; ++y)
        std::fill_n(rows[y], kPictureSize.width, 90 * 0x01010101U);
    for (const char* text : {"the camera has gone", "the still camera has gone as well"}) {
        const Picture onHost = banner.over(Rows<const std::uint32_t>(rows.rows()), text);
        ASSERT_TRUE(onHost.isOnHost());
        EXPECT_EQ(pixelsOf(onHost),
                  pixelsOf(banner.over(GlImage{texture.id(), kPictureSize}, text)));
    }
    EXPECT_EQ(rows[239][319], 90 * 0x01010101U);
}

// mfard draws this banner even if it has no GL context.
TEST_F(BannerText, WithoutAPictureTheBannerIsOnBlack) {
    Banner banner(kPictureSize);
    ASSERT_TRUE(banner.over({}, "no picture yet").isOnHost());
    const auto shown = pixelsOf(banner.over({}, "no picture yet"));
    EXPECT_GE(rowsOf(shown, 0), 200);
    EXPECT_LT(rowsOf(shown, 0), 235);
}

}  // namespace
}  // namespace mfar
