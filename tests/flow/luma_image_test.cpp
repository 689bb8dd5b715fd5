#include "pipeline/flow/luma_image.h"
#include "tests/oracle/yuv.h"
#include "tests/unit/padded_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

namespace mfar {
namespace {

LumaImage pictureOf(Size size, const std::function<double(int, int)>& grey) {
    LumaImage out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.row(y)[x] =
                static_cast<std::uint8_t>(std::lround(std::clamp(grey(x, y), 0.0, 255.0)));
    return out;
}

LumaImage randomPicture(Size size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> grey(0, 255);
    return pictureOf(size, [&](int, int) { return grey(random); });
}

int clampedAt(const LumaImage& picture, int x, int y) {
    return picture.row(
        std::clamp(y, 0, picture.size.height - 1))[std::clamp(x, 0, picture.size.width - 1)];
}

double greyScene(int x, int y) {
    double grey = 40 + 0.2 * x + 0.1 * y;
    if (x > 90) grey += 60;
    if (y > 70) grey += 25;
    if (3 * x + 2 * y < 120) grey += 50;
    if (x > 120 && y < 40) grey += 12 * std::sin(0.9 * x) * std::cos(0.7 * y);
    return grey;
}

TEST(LumaOf, LumaOfRgbaMatchesRec601WithinRounding) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> byte(0, 255);
    constexpr Size kSize{23, 11};
    constexpr std::size_t kStride = 4UL * 23 + 12;
    std::vector<std::uint8_t> bytes(kStride * 11);
    for (std::uint8_t& b : bytes)
        b = static_cast<std::uint8_t>(byte(random));
    LumaImage luma;
    lumaOf({bytes.data(), kSize, kStride, PixelFormat::Rgba8}, luma);
    ASSERT_EQ(luma.size, kSize);
    ASSERT_EQ(luma.pixels.size(), 23UL * 11);
    for (int y = 0; y < 11; ++y) {
        for (int x = 0; x < 23; ++x) {
            const std::uint8_t* p = bytes.data() + kStride * y + 4UL * x;
            ASSERT_NEAR(luma.row(y)[x], 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2], 0.503);
        }
    }
}

TEST(LumaOf, BgraGivesTheLumaOfRgbaWithRedAndBlueExchanged) {
    const test::PaddedPicture picture(PixelFormat::Bgra8, {22, 14}, 3);
    LumaImage luma;
    lumaOf(picture.view(), luma);
    for (int y = 0; y < 14; ++y) {
        for (int x = 0; x < 22; ++x) {
            const auto rgb = twin::rgbAt(picture.view(), x, y);
            ASSERT_NEAR(luma.row(y)[x], 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2], 0.503);
        }
    }
}

TEST(LumaOf, TheLumaPlaneOfYuvPicturesIsCopied) {
    Workers workers(2);
    for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        const test::PaddedPicture picture(format, {22, 14}, 3);
        LumaImage luma, shrunk;
        lumaOf(picture.view(), luma);
        shrinkLuma(picture.view(), {22, 14}, workers, shrunk);
        const auto y = twin::yuvSamples(picture.view())[0];
        for (int row = 0; row < 14; ++row) {
            for (int x = 0; x < 22; ++x) {
                ASSERT_EQ(luma.row(row)[x], y.at(x, row));
                ASSERT_EQ(shrunk.row(row)[x], y.at(x, row));
            }
        }
    }
}

TEST(LumaOf, GreyIsUnchangedAndAlphaIsIgnored) {
    LumaImage luma;
    for (int grey = 0; grey < 256; ++grey) {
        for (const int alpha : {0, 255}) {
            const auto v = static_cast<std::uint8_t>(grey);
            const std::array<std::uint8_t, 4> pixel{v, v, v, static_cast<std::uint8_t>(alpha)};
            lumaOf({pixel.data(), {1, 1}, 4, PixelFormat::Rgba8}, luma);
            ASSERT_EQ(luma.pixels[0], grey);
        }
    }
}

TEST(LumaOf, GreyPicturesLoseTheirPadding) {
    const LumaImage padded = randomPicture({20, 6}, 4);
    LumaImage luma({3, 3});
    lumaOf({padded.pixels.data(), {17, 6}, 20, PixelFormat::Gray8}, luma);
    ASSERT_EQ(luma.size, (Size{17, 6}));
    for (int y = 0; y < 6; ++y)
        EXPECT_TRUE(std::equal(luma.row(y), luma.row(y) + 17, padded.row(y)));
}

TEST(Halve, APixelIsTheMeanOfFourPixelsWithTheBorderRepeated) {
    for (const Size size : {Size{1, 1}, Size{2, 2}, Size{1, 6}, Size{7, 1}, Size{3, 3}, Size{8, 5},
                            Size{5, 8}, Size{61, 45}}) {
        const LumaImage fine = randomPicture(size, 8);
        LumaImage coarse;
        halve(fine, coarse);
        ASSERT_EQ(coarse.size, (Size{(size.width + 1) / 2, (size.height + 1) / 2}));
        for (int y = 0; y < coarse.size.height; ++y) {
            for (int x = 0; x < coarse.size.width; ++x) {
                const int sum = clampedAt(fine, 2 * x, 2 * y) + clampedAt(fine, 2 * x + 1, 2 * y) +
                                clampedAt(fine, 2 * x, 2 * y + 1) +
                                clampedAt(fine, 2 * x + 1, 2 * y + 1);
                ASSERT_EQ(coarse.row(y)[x], (sum + 2) / 4)
                    << x << ',' << y << " of " << size.width << 'x' << size.height;
            }
        }
    }
}

TEST(Halve, UniformPicturesStayUniform) {
    LumaImage coarse;
    for (const int grey : {0, 1, 254, 255}) {
        halve(pictureOf({9, 7}, [&](int, int) { return grey; }), coarse);
        for (const std::uint8_t p : coarse.pixels)
            ASSERT_EQ(p, grey);
    }
}

TEST(Smooth, AppliesTheSeparableMaskWithTheBorderRepeated) {
    for (const float side : {0.0F, 0.1F, 0.25F, 1.0F / 3}) {
        for (const Size size : {Size{1, 1}, Size{1, 5}, Size{6, 1}, Size{13, 9}}) {
            const LumaImage in = randomPicture(size, 12);
            LumaImage out;
            smooth(in, side, out);
            ASSERT_EQ(out.size, size);
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    double sum = 0;
                    for (int j = -1; j <= 1; ++j)
                        for (int i = -1; i <= 1; ++i)
                            sum += (i == 0 ? 1 - 2.0 * side : side) *
                                   (j == 0 ? 1 - 2.0 * side : side) * clampedAt(in, x + i, y + j);
                    // Tolerance: smooth() rounds `side` to a multiple of 1/256, an error of up to
                    // 0.002. Along each axis, this changes a pixel by up to 255 * 2 * 0.002.
                    ASSERT_NEAR(out.row(y)[x], sum, 0.5 + 255 * 4 * 0.002) << side;
                }
            }
        }
    }
}

TEST(Smooth, WithoutSideWeightsThePictureIsCopiedAndUniformPicturesStayUniform) {
    const LumaImage in = randomPicture({21, 17}, 14);
    LumaImage out;
    smooth(in, 0, out);
    EXPECT_EQ(out.pixels, in.pixels);
    for (const int grey : {0, 77, 255}) {
        smooth(pictureOf({8, 8}, [&](int, int) { return grey; }), 0.25F, out);
        for (const std::uint8_t p : out.pixels)
            ASSERT_EQ(p, grey);
    }
}

TEST(NoiseOf, FindsWhiteNoiseOnSlopesAndEdges) {
    for (const double sigma : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0}) {
        for (unsigned seed = 1; seed <= 3; ++seed) {
            std::mt19937 random(seed);
            std::normal_distribution<double> noise(0, sigma);
            const LumaImage picture = pictureOf(
                {200, 150}, [&](int x, int y) { return greyScene(x, y) + noise(random); });
            EXPECT_NEAR(noiseOf(picture), sigma, 0.2 * sigma) << "seed " << seed;
        }
    }
}

TEST(NoiseOf, IsNearZeroWithoutNoise) {
    EXPECT_LT(noiseOf(pictureOf({200, 150}, greyScene)),
              0.45);  // rounding to grey levels alone gives 0.29
    EXPECT_EQ(noiseOf(pictureOf({64, 64}, [](int, int) { return 255; })), 0);
    EXPECT_EQ(noiseOf(pictureOf({64, 64}, [](int x, int y) { return 2 * x + y; })), 0);
    EXPECT_EQ(noiseOf(pictureOf({64, 64}, [](int x, int) { return x < 29 ? 20 : 220; })), 0);
    EXPECT_EQ(noiseOf(pictureOf({64, 64}, [](int, int y) { return y == 29 ? 20 : 220; })), 0);
}

TEST(NoiseOf, TheNoiseOfPicturesSmallerThanABlockIsZero) {
    EXPECT_EQ(noiseOf(randomPicture({1, 1}, 1)), 0);
    EXPECT_EQ(noiseOf(randomPicture({9, 200}, 1)), 0);
    EXPECT_GT(noiseOf(randomPicture({10, 10}, 1)), 0);
}

}  // namespace
}  // namespace mfar
