#include "pipeline/models/environment_map.h"
#include "pipeline/models/gltf_model.h"
#include "tests/models/gltf_maker.h"
#include "tests/unit/temp_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>

namespace mfar {
namespace {

using testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

Bytes hdr(const std::string& header, const Bytes& pixels) {
    Bytes out(header.begin(), header.end());
    out.insert(out.end(), pixels.begin(), pixels.end());
    return out;
}

const std::string kHeader = "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n";

std::string environmentFault(const Bytes& bytes, std::size_t memory = kEnvironmentMemory) {
    try {
        (void)parseEnvironment(bytes, "sky.hdr", memory);
        return "none";
    } catch (const ModelError& error) {
        return error.what();
    }
}

void expectClose(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    EXPECT_LT((a - b).norm(), 1e-3F * (1 + b.norm())) << a.transpose() << " / " << b.transpose();
}

TEST(EnvironmentMap, UncompressedPixelsAreRead) {
    const Environment e =
        parseEnvironment(hdr(kHeader + "-Y 1 +X 2\n", {128, 64, 0, 129, 255, 255, 255, 130}), "a");
    EXPECT_EQ(e.size, (Size{2, 1}));
    // The expected values are the middles of the mantissa's quantisation steps.
    expectClose(e.radiance[0], {128.5F / 128, 64.5F / 128, 0.5F / 128});
    expectClose(e.radiance[1], Eigen::Vector3f::Constant(255.5F / 64));
}

TEST(EnvironmentMap, NewAndOldRunLengthEncodingsAreRead) {
    // Four rows of eight pixels in the new format, which stores R, G, B and E of a row one after
    // the other. R, B and E are run-length encoded, G is not.
    Bytes rows;
    for (int y = 0; y < 4; ++y) {
        const auto level = static_cast<std::uint8_t>(10 * y);
        const Bytes row = {2, 2, 0, 8, 136, level, 8, 1, 2, 3, 4, 5, 6, 7, 8, 136, 9, 136, 136};
        rows.insert(rows.end(), row.begin(), row.end());
    }
    const Environment split = parseEnvironment(hdr(kHeader + "-Y 4 +X 8\n", rows), "a");
    expectClose(split.radiance[3 * 8 + 5], {30.5F, 6.5F, 9.5F});
    rows.clear();
    for (int y = 0; y < 4; ++y)
        rows.insert(rows.end(), {5, 6, 7, 136, 1, 1, 1, 7});
    const Environment old = parseEnvironment(hdr(kHeader + "-Y 4 +X 8\n", rows), "a");
    expectClose(old.radiance[31], {5.5F, 6.5F, 7.5F});
}

TEST(EnvironmentMap, RadianceIsDividedByTheExposureInTheHeader) {
    const Environment e = parseEnvironment(
        hdr("#?RGBE\nEXPOSURE=2\nEXPOSURE= 4.0\n\n-Y 1 +X 2\n", {8, 8, 8, 136, 0, 0, 0, 0}), "a");
    expectClose(e.radiance[0], Eigen::Vector3f::Constant(8.5F / 8));
    EXPECT_EQ(e.radiance[1], Eigen::Vector3f(0, 0, 0));
}

TEST(EnvironmentMap, EightBitPicturesAreLinearised) {
    const Environment e = parseEnvironment(
        test::rgbaPng({2, 1}, {{{255, 188, 0, 255}}, {{128, 10, 5, 255}}}), "a.png");
    expectClose(e.radiance[0], {1, 0.5029F, 0});
    expectClose(e.radiance[1], {0.2159F, 0.003035F, 0.001518F});
}

TEST(EnvironmentMap, LargePicturesAreReducedByAveraging) {
    // 2048 rows of 4096 equal pixels; every other row is twice as bright.
    Bytes rows;
    for (int y = 0; y < 2048; ++y) {
        rows.insert(rows.end(), {2, 2, 16, 0});
        for (int channel = 0; channel < 4; ++channel) {
            const auto level = static_cast<std::uint8_t>(channel < 3 ? 100 : 136 + y % 2);
            for (int run = 0; run < 64; ++run)
                rows.insert(rows.end(), {128 + 64, level});
        }
    }
    const Environment e = parseEnvironment(hdr(kHeader + "-Y 2048 +X 4096\n", rows), "a");
    EXPECT_EQ(e.size, (Size{2048, 1024}));
    for (const std::size_t i : {std::size_t{0}, std::size_t{2048}, e.radiance.size() - 1})
        expectClose(e.radiance[i], Eigen::Vector3f::Constant(1.5F * 100.5F));
}

TEST(EnvironmentMap, InvalidFilesAreRefused) {
    const Bytes pixel = {8, 8, 8, 136};
    for (const char* wrong : {"", "words"})
        EXPECT_EQ(environmentFault(hdr(wrong, {})),
                  "sky.hdr: is neither a Radiance picture (.hdr), PNG nor JPEG");
    EXPECT_THAT(environmentFault(hdr("#?RADIANCE\n", {})),
                HasSubstr("header of the Radiance picture is invalid"));
    EXPECT_THAT(environmentFault(hdr("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n", pixel)),
                HasSubstr("xyze is not supported"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "+Y 1 +X 2\n", pixel)), HasSubstr("the row order"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 1 +X 99999999999\n", pixel)),
                HasSubstr("the row order"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 1 +X 2\n", pixel)),
                HasSubstr("ends before the picture is complete"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 20000 +X 40000\n", pixel)),
                HasSubstr("at most 16384"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 2147483647 +X 2\n", pixel)),
                HasSubstr("at most 16384"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 10 +X 10\n", pixel)),
                HasSubstr("twice as wide as high"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 1 +X 2\n", {1, 1, 1, 2})),
                HasSubstr("a row of pixels is invalid"));
    EXPECT_THAT(environmentFault(hdr(kHeader + "-Y 4 +X 8\n", {2, 2, 0, 8, 255, 1, 0, 0})),
                HasSubstr("a row of pixels is invalid"));
    EXPECT_THAT(environmentFault(hdr("#?RGBE\nEXPOSURE=0\n\n-Y 1 +X 2\n", pixel)),
                HasSubstr("EXPOSURE"));
    const test::TempFolder folder;
    EXPECT_THROW((void)loadEnvironment(folder / "none.hdr"), ModelError);
}

// The smallest picture, of 2x1 pixels, needs 32 bytes.
TEST(EnvironmentMap, APictureThatExceedsTheMemoryIsRefused) {
    const Bytes picture = hdr(kHeader + "-Y 1 +X 2\n", Bytes(8, 136));
    EXPECT_EQ(environmentFault(picture, 32), "none");
    EXPECT_THAT(environmentFault(picture, 31),
                HasSubstr("needs 1 MB of memory, but only 0 MB are left"));
}

// As in scene.h: column 0 is -x, +y is at three quarters of the width, row 0 is up.
TEST(EnvironmentMap, DirectionsFollowTheScenesAxes) {
    expectClose(environmentDirection(0, 0.5F), {-1, 0, 0});
    expectClose(environmentDirection(0.75F, 0.5F), {0, 1, 0});
    expectClose(environmentDirection(0.3F, 0), {0, 0, 1});
}

void expectBalanced(const Environment& e) {
    double up = 0, down = 0;
    for (int y = 0; y < e.size.height; ++y) {
        for (int x = 0; x < e.size.width; ++x) {
            const Eigen::Vector3f& light =
                e.radiance[static_cast<std::size_t>(y) * e.size.width + x];
            ASSERT_TRUE(light.allFinite() && light.minCoeff() >= 0);
            const double fromUp = (y + 0.5) * std::numbers::pi / e.size.height;
            const double part =
                std::sin(fromUp) * 2 * std::pow(std::numbers::pi, 2) / e.size.width / e.size.height;
            (fromUp < std::numbers::pi / 2 ? up : down) +=
                std::abs(std::cos(fromUp)) * part * light.y();
        }
    }
    EXPECT_NEAR(up / std::numbers::pi, 1, 1e-3);
    EXPECT_LT(down, up / 2) << "most light must come from above";
}

TEST(EnvironmentMap, StudioAndSkyEnvironmentsLightATableFromAboveWithIrradiancePi) {
    expectBalanced(studioEnvironment());
    expectBalanced(skyEnvironment(Eigen::Vector3f(0.5F, 0.3F, 0.6F).normalized()));
}

}  // namespace
}  // namespace mfar
