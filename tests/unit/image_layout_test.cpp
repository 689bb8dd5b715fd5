#include "base/image_layout.h"
#include "tests/oracle/yuv.h"
#include "tests/unit/padded_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace mfar {
namespace {

using test::kEveryFormat;
using test::PaddedPicture;

std::string faultOf(const ImageView& view) {
    try {
        requireSound(view, "still");
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "sound";
}

TEST(ImageLayout, PlanesFollowEachOtherWithoutGaps) {
    EXPECT_EQ(packedBytes(PixelFormat::Gray8, {6, 4}), 24U);
    EXPECT_EQ(packedBytes(PixelFormat::Bgra8, {6, 4}), 96U);
    EXPECT_EQ(packedBytes(PixelFormat::Yuyv, {6, 4}), 48U);
    EXPECT_EQ(packedBytes(PixelFormat::Nv12, {6, 4}), 36U);
    EXPECT_EQ(packedBytes(PixelFormat::Yuv420, {6, 4}), 36U);
    const std::vector<std::uint8_t> bytes(36);
    const ImageView planes = packedView(bytes.data(), {6, 4}, PixelFormat::Yuv420);
    EXPECT_EQ(planes.chroma[0].data - bytes.data(), 24);
    EXPECT_EQ(planes.chroma[1].data - bytes.data(), 30);
    EXPECT_EQ(planes.chroma[1].stride, 3U);
    EXPECT_EQ(packedView(bytes.data(), {6, 4}, PixelFormat::Nv12).chroma[0].stride, 6U);
}

TEST(ImageLayout, PackingKeepsEveryPixelAndDropsThePadding) {
    for (const PixelFormat format : kEveryFormat) {
        const PaddedPicture padded(format, {22, 14}, 5);
        const ImageView from = padded.view(YuvMatrix::Bt709, YuvRange::Full);
        std::vector<std::uint8_t> bytes(packedBytes(format, from.size));
        const ImageView packed = packInto(bytes.data(), from);
        EXPECT_NO_THROW(requireSound(packed, "packed"));
        EXPECT_EQ(packed.stride, 22U * bytesPerPixel(format));
        for (int y = 0; y < 14; ++y)
            for (int x = 0; x < 22; ++x)
                ASSERT_EQ(twin::rgbAt(packed, x, y), twin::rgbAt(from, x, y)) << nameOf(format);
    }
}

TEST(ImageLayout, ValidPicturesOfEveryFormatAreAccepted) {
    for (const PixelFormat format : kEveryFormat)
        EXPECT_EQ(faultOf(PaddedPicture(format, {22, 14}, 1).view()), "sound") << nameOf(format);
    EXPECT_EQ(faultOf(PaddedPicture(PixelFormat::Gray8, {3, 5}, 1).view()), "sound");
    EXPECT_EQ(faultOf(PaddedPicture(PixelFormat::Yuyv, {2, 1}, 1).view()), "sound");
}

TEST(ImageLayout, EachFaultIsReported) {
    const PaddedPicture nv12(PixelFormat::Nv12, {22, 14}, 1), yuyv(PixelFormat::Yuyv, {22, 14}, 1);
    ImageView view = nv12.view();
    view.size = {21, 14};
    EXPECT_EQ(faultOf(view), "still: 21x14 has an odd side, which NV12 does not allow");
    view.size = {22, 13};
    EXPECT_EQ(faultOf(view), "still: 22x13 has an odd side, which NV12 does not allow");
    view.size = {22, 0};
    EXPECT_EQ(faultOf(view), "still: 22x0 is not a valid picture size");
    view.size = {2, std::numeric_limits<int>::max()};
    EXPECT_EQ(faultOf(view), "still: 2x2147483647 is not a valid picture size");
    view = nv12.view();
    view.chroma[0].data = nullptr;
    EXPECT_EQ(faultOf(view), "still: plane 1 of NV12 is missing");
    view = nv12.view();
    view.chroma[0].stride = 21;
    EXPECT_EQ(faultOf(view),
              "still: plane 1 of NV12 has rows of 21 bytes, but a row of the picture needs 22");
    view = nv12.view();
    view.stride = 21;
    EXPECT_EQ(faultOf(view),
              "still: plane 0 of NV12 has rows of 21 bytes, but a row of the picture needs 22");
    view = yuyv.view();
    view.stride = 43;
    EXPECT_EQ(faultOf(view),
              "still: plane 0 of YUYV has rows of 43 bytes, but a row of the picture needs 44");
    EXPECT_EQ(faultOf({}), "still: 0x0 is not a valid picture size");
}

TEST(ImageLayout, LumaPlaneIsNotCopied) {
    for (const PixelFormat format : {PixelFormat::Gray8, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        const PaddedPicture picture(format, {22, 14}, 1);
        const auto luma = lumaPlane(picture.view());
        ASSERT_TRUE(luma.has_value());
        EXPECT_EQ(luma->data, picture.view().data);
        EXPECT_EQ(luma->stride, picture.view().stride);
        EXPECT_EQ(luma->format, PixelFormat::Gray8);
        EXPECT_EQ(luma->chroma[0].data, nullptr);
    }
    for (const PixelFormat format : {PixelFormat::Rgba8, PixelFormat::Bgra8, PixelFormat::Yuyv})
        EXPECT_FALSE(lumaPlane(PaddedPicture(format, {22, 14}, 1).view()).has_value());
}

TEST(YuvToRgb, MatrixMatchesTheStandards) {
    for (const YuvMatrix matrix : {YuvMatrix::Bt601, YuvMatrix::Bt709})
        for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
            const YuvToRgb rows = yuvToRgb(matrix, range);
            ImageView of;
            of.matrix = matrix;
            of.range = range;
            for (int i = 0; i < 8; ++i) {
                const double y = (i & 1) * 255, u = (i >> 1 & 1) * 255, v = (i >> 2) * 255;
                const auto expected = twin::rgbOfYuv(y, u, v, of);
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_NEAR(rows[c][0] * y + rows[c][1] * u + rows[c][2] * v + rows[c][3],
                                expected[c], 0.001);
            }
        }
}

TEST(YuvToRgb, EndsOfTheLumaRangeAreBlackAndWhite) {
    const auto greyOf = [](YuvRange range, float y) {
        const auto row = yuvToRgb(YuvMatrix::Bt709, range)[1];
        return row[0] * y + (row[1] + row[2]) * 128 + row[3];
    };
    EXPECT_NEAR(greyOf(YuvRange::Limited, 16), 0, 1e-3);
    EXPECT_NEAR(greyOf(YuvRange::Limited, 235), 255, 1e-3);
    EXPECT_NEAR(greyOf(YuvRange::Full, 0), 0, 1e-3);
    EXPECT_NEAR(greyOf(YuvRange::Full, 255), 255, 1e-3);
}

}  // namespace
}  // namespace mfar
