#include "pipeline/plan/rgb_planes.h"
#include "pipeline/plan/tiles.h"
#include "tests/oracle/yuv.h"
#include "tests/unit/padded_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr Size kCutSize{54, 38};

double worstAgainstTwin(const ImageView& view) {
    RgbPlanes planes(view.size);
    planes.take(view);
    double worst = 0;
    for (int y = 0; y < kTileSize * planes.tiles().height; ++y)
        for (int x = 0; x < planes.pitch(); ++x) {
            const auto rgb = twin::rgbAt(view, std::min(x, view.size.width - 1),
                                         std::min(y, view.size.height - 1));
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(planes.row(c, y)[x] - rgb[c]));
        }
    return worst;
}

TEST(RgbPlanes, EveryFormatMatchesTheOracleIncludingTheRepeatedBorder) {
    for (const PixelFormat format : test::kEveryFormat) {
        const test::PaddedPicture source(format, kCutSize, 3);
        for (const YuvMatrix matrix : {YuvMatrix::Bt601, YuvMatrix::Bt709})
            for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
                const bool exact = format == PixelFormat::Gray8 || format == PixelFormat::Rgba8 ||
                                   format == PixelFormat::Bgra8;
                EXPECT_LE(worstAgainstTwin(source.view(matrix, range)), exact ? 0 : 0.8)
                    << nameOf(format);
            }
    }
}

TEST(RgbPlanes, TheSmallestPicturesOfEveryFormatAreConverted) {
    for (const PixelFormat format : test::kEveryFormat) {
        const test::PaddedPicture source(format, {2, 2}, 7);
        EXPECT_LE(worstAgainstTwin(source.view()), 0.8) << nameOf(format);
    }
    const test::PaddedPicture pixel(PixelFormat::Rgba8, {1, 1}, 7);
    EXPECT_EQ(worstAgainstTwin(pixel.view()), 0);
}

TEST(RgbPlanes, OnlyTheGivenTileIsCopied) {
    RgbPlanes from(kCutSize), to(kCutSize);
    from.take(test::PaddedPicture(PixelFormat::Rgba8, kCutSize, 5).view());
    to.take(test::PaddedPicture(PixelFormat::Rgba8, kCutSize, 6).view());
    const RgbPlanes before = to;
    to.takeTile(from, 3, 2);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < to.pitch(); ++x) {
                const RgbPlanes& wanted = x >= 48 && y >= 32 ? from : before;
                ASSERT_EQ(to.row(c, y)[x], wanted.row(c, y)[x]) << x << ", " << y;
            }
}

}  // namespace
}  // namespace mfar
