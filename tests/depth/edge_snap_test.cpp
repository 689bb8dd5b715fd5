#include "pipeline/depth/edge_snap.h"
#include "tests/oracle/yuv.h"
#include "tests/unit/padded_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr Size kPicture{64, 48};
constexpr PixelRect kAllPixels{0, 0, 64, 48};
constexpr int kEdge = 30;

std::vector<std::uint8_t> picture(int left = 60, int right = 160) {
    std::vector<std::uint8_t> out;
    for (int y = 0; y < kPicture.height; ++y)
        for (int x = 0; x < kPicture.width; ++x)
            out.push_back(
                static_cast<std::uint8_t>((x < kEdge ? left : right) + (x * 7 + y * 5) % 9));
    return out;
}

/// Depth of the surfaces in picture(). The near surface extends `too` pixels beyond its true edge.
/// The depth of the next `unknown` pixels is unknown.
InverseDepthField field(int too, int unknown) {
    InverseDepthField out(kPicture);
    for (int y = 0; y < kPicture.height; ++y)
        for (int x = 0; x < kPicture.width; ++x) {
            const auto i = static_cast<std::size_t>(y) * kPicture.width + x;
            if (x >= kEdge + too && x < kEdge + too + unknown) continue;
            out.inverseDepth[i] = x < kEdge + too ? 2.0F : 0.5F;
            out.variance[i] = 1e-4F;
        }
    return out;
}

void paintHalves(test::PaddedPicture& out) {
    const ImageView view = out.view();
    const int step = bytesPerPixel(view.format);
    for (int plane = 0; plane < planeCount(view.format); ++plane) {
        const std::size_t stride =
            plane == 0 ? view.stride : view.chroma[static_cast<std::size_t>(plane) - 1].stride;
        const int pixels = view.format == PixelFormat::Nv12 && plane == 1 ? 1
                           : plane == 0                                   ? step
                                                                          : 0;
        for (std::size_t i = 0; i < out.plane(plane).size(); ++i) {
            const auto column = static_cast<int>(i % stride);
            const int x = pixels == 0 ? 2 * column : column / pixels;
            const bool left = x < kEdge;
            std::uint8_t& b = out.plane(plane)[i];
            if (step == 4)
                b = std::array<std::uint8_t, 4>{left ? std::uint8_t{200} : std::uint8_t{60}, 110,
                                                left ? std::uint8_t{60} : std::uint8_t{200},
                                                255}[static_cast<std::size_t>(column) % 4];
            else if (plane == 0 && (step == 1 || column % 2 == 0))
                b = 110;
            else
                b = left ? 90 : 166;
        }
    }
}

InverseDepthField snapped(const InverseDepthField& in, const std::vector<std::uint8_t>& pixels,
                          const PixelRect& where = kAllPixels) {
    EdgeSnap snap(kPicture, std::make_shared<Workers>(2));
    const ImageView view{pixels.data(), kPicture, 64, PixelFormat::Gray8};
    snap.run(in, view, kAllPixels);
    return snap.run(in, view, where);
}

TEST(EdgeSnap, DepthEdgesMoveToPictureEdges) {
    for (const int unknown : {0, 2})
        for (int too = -2; too <= 2; ++too) {
            const InverseDepthField out = snapped(field(too, unknown), picture());
            for (int y = 0; y < kPicture.height; ++y)
                for (int x = 0; x < kPicture.width; ++x) {
                    const auto i = static_cast<std::size_t>(y) * kPicture.width + x;
                    ASSERT_TRUE(out.isKnown(i));
                    ASSERT_NEAR(out.inverseDepth[i], x < kEdge ? 2 : 0.5, 1e-4)
                        << x << "," << y << " off " << too << " gap " << unknown;
                }
        }
}

// The surfaces differ only in colour. So chroma must be read correctly from every format.
TEST(EdgeSnap, SurfacesAreDistinguishedByColourInEveryFormat) {
    for (const PixelFormat format : test::kEveryFormat) {
        if (format == PixelFormat::Gray8) continue;
        test::PaddedPicture painted(format, kPicture, 1);
        paintHalves(painted);
        EdgeSnap snap(kPicture, std::make_shared<Workers>(2));
        for (const int too : {-2, 2}) {
            const InverseDepthField& out = snap.run(field(too, 0), painted.view(), kAllPixels);
            for (int y = 0; y < kPicture.height; ++y)
                for (int x = 0; x < kPicture.width; ++x)
                    ASSERT_NEAR(out.inverseDepth[static_cast<std::size_t>(y) * kPicture.width + x],
                                x < kEdge ? 2 : 0.5, 1e-4)
                        << nameOf(format) << " " << x << "," << y;
        }
    }
}

// The RGB picture is computed from the YUV picture, without interpolation of its chroma samples. So
// the colours of the two pictures differ only by rounding.
TEST(EdgeSnap, AYuvPictureAndTheEqualRgbPictureGiveTheSameDepth) {
    for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        test::PaddedPicture painted(format, kPicture, 6);
        for (int plane = 0; plane < planeCount(format); ++plane)
            for (auto& b : painted.plane(plane))
                b = static_cast<std::uint8_t>(110 + b / 8);
        const ImageView view = painted.view(YuvMatrix::Bt709, YuvRange::Limited);
        const auto samples = twin::yuvSamples(view);
        const int down = format == PixelFormat::Yuyv ? 1 : 2;
        std::vector<std::uint8_t> rgba;
        for (int y = 0; y < kPicture.height; ++y)
            for (int x = 0; x < kPicture.width; ++x) {
                for (const double c :
                     twin::rgbOfYuv(samples[0].at(x, y), samples[1].at(x / 2, y / down),
                                    samples[2].at(x / 2, y / down), view))
                    rgba.push_back(static_cast<std::uint8_t>(std::clamp(c, 0.0, 255.0)));
                rgba.push_back(255);
            }
        EdgeSnap snap(kPicture, std::make_shared<Workers>(2));
        const InverseDepthField in = field(1, 3);
        const InverseDepthField a = snap.run(in, view, kAllPixels);
        const InverseDepthField b =
            snap.run(in, packedView(rgba.data(), kPicture, PixelFormat::Rgba8), kAllPixels);
        EXPECT_GT(std::count(a.filled.begin(), a.filled.end(), 1), 100);
        int differ = 0;
        for (std::size_t i = 0; i < a.inverseDepth.size(); ++i)
            if (!(std::abs(a.inverseDepth[i] - b.inverseDepth[i]) < 0.01F)) ++differ;
        EXPECT_LE(differ, 20) << nameOf(format);
    }
}

TEST(EdgeSnap, DepthOfASlopeStaysUnchanged) {
    InverseDepthField in(kPicture);
    for (std::size_t i = 0; i < in.inverseDepth.size(); ++i) {
        in.inverseDepth[i] = 1 + 0.004F * static_cast<float>(i % 64);
        in.variance[i] = 1e-6F;
    }
    const InverseDepthField out = snapped(in, picture());
    EXPECT_EQ(out.inverseDepth, in.inverseDepth);
    EXPECT_EQ(out.filled, in.filled);
}

TEST(EdgeSnap, PixelsFilledWithoutAMeasurementAreMarked) {
    const InverseDepthField out = snapped(field(0, 5), picture());
    EXPECT_EQ(out.filled[24UL * 64 + kEdge + 2], 1);
    EXPECT_EQ(out.filled[24UL * 64 + 5], 0);
}

TEST(EdgeSnap, UnknownDepthStaysUnknown) {
    const InverseDepthField out = snapped(InverseDepthField(kPicture), picture());
    for (std::size_t i = 0; i < out.inverseDepth.size(); ++i)
        EXPECT_FALSE(out.isKnown(i));
}

TEST(EdgeSnap, OnlyTheRegionIsProcessed) {
    const PixelRect where{20, 10, 44, 30};
    const InverseDepthField out = snapped(field(2, 0), picture(), where);
    for (int y = 0; y < kPicture.height; ++y)
        for (int x = 0; x < kPicture.width; ++x) {
            const bool inside = x >= where.x0 && x < where.x1 && y >= where.y0 && y < where.y1;
            EXPECT_EQ(out.isKnown(static_cast<std::size_t>(y) * 64 + x), inside);
        }
}

}  // namespace
}  // namespace mfar
