#include "pipeline/track/corner_refine.h"
#include "pipeline/track/luma_window.h"
#include "tests/oracle/yuv.h"
#include "tests/track/tag_scene.h"
#include "tests/unit/padded_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mfar {
namespace {

using test::PaddedPicture;

constexpr Size kSize{32, 24};
constexpr PixelRect kPart{5, 3, 27, 20};

TEST(LumaWindow, EveryFormatGivesTheLumaOfTheRequestedPart) {
    for (const PixelFormat format : test::kEveryFormat) {
        const PaddedPicture picture(format, kSize, 7);
        LumaWindow window;
        const ImageView luma = window.of(picture.view(), kPart);
        ASSERT_EQ(luma.format, PixelFormat::Gray8);
        ASSERT_EQ(luma.size, kSize);
        const bool packedRgb = bytesPerPixel(format) == 4;
        for (int y = kPart.y0; y < kPart.y1; ++y)
            for (int x = kPart.x0; x < kPart.x1; ++x) {
                const auto rgb = twin::rgbAt(picture.view(), x, y);
                const double expected =
                    packedRgb
                        ? 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]
                        : picture.view()
                              .data[y * picture.view().stride + 1UL * x * bytesPerPixel(format)];
                // Tolerance: the weights are rounded to multiples of 1/256.
                ASSERT_NEAR(luma.data[y * luma.stride + x], expected, packedRgb ? 1.4 : 0)
                    << nameOf(format);
            }
    }
}

TEST(LumaWindow, LumaPlanesAreNotCopied) {
    LumaWindow window;
    for (const PixelFormat format : {PixelFormat::Gray8, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        const PaddedPicture picture(format, kSize, 7);
        EXPECT_EQ(window.of(picture.view(), kPart).data, picture.view().data);
    }
}

TEST(LumaWindow, LimitedLumaRangeHardlyMovesCorners) {
    const CameraModel camera = test::testCamera();
    const test::PlacedTag placed{{TagFamily::Tag36h11, 5}, 0.1, {}};
    const auto pose = test::cameraAt(0.4, 0.5, 0.3, 0.2);
    const test::GrayPicture full = test::renderTags(camera, pose, {placed});
    test::GrayPicture limited = full;
    for (auto& p : limited.pixels)
        p = static_cast<std::uint8_t>(std::lround(16 + p * 219.0 / 255));
    const auto cornersIn = [&](const test::GrayPicture& picture) {
        TagDetector detector({});
        auto tags = detector.detect(picture.view());
        EXPECT_EQ(tags.size(), 1U);
        CornerRefiner(2.2).refine(picture.view(), camera, tags.at(0));
        return tags.at(0).corners;
    };
    const auto a = cornersIn(full), b = cornersIn(limited);
    for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_LT((a[i] - b[i]).norm(), 0.02) << i;
}

}  // namespace
}  // namespace mfar
