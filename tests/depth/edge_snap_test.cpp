#include "pipeline/depth/edge_snap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mfar {
namespace {

constexpr Size kPicture{64, 48};
constexpr PixelRect kAllPixels{0, 0, 64, 48};
constexpr int kEdge = 30;

/// A dark surface left of kEdge before a bright one, with a fine pattern on both.
std::vector<std::uint8_t> picture(int left = 60, int right = 160) {
    std::vector<std::uint8_t> out;
    for (int y = 0; y < kPicture.height; ++y)
        for (int x = 0; x < kPicture.width; ++x)
            out.push_back(
                static_cast<std::uint8_t>((x < kEdge ? left : right) + (x * 7 + y * 5) % 9));
    return out;
}

/// The near surface reaches `too` pixels too far; between them `unknown` pixels.
InverseDepthField field(int too, int unknown) {
    InverseDepthField out(kPicture);
    for (int y = 0; y < kPicture.height; ++y)
        for (int x = 0; x < kPicture.width; ++x) {
            const auto i = static_cast<std::size_t>(y) * kPicture.width + x;
            if (x >= kEdge + too && x < kEdge + too + unknown) continue;
            out.rho[i] = x < kEdge + too ? 2.0F : 0.5F;
            out.variance[i] = 1e-4F;
        }
    return out;
}

InverseDepthField snapped(const InverseDepthField& in, const std::vector<std::uint8_t>& pixels,
                          const PixelRect& where = kAllPixels) {
    EdgeSnap snap(kPicture, std::make_shared<Workers>(2));
    const ImageView view{pixels.data(), kPicture, 64, PixelFormat::Gray8};
    snap.run(in, view, kAllPixels);
    return snap.run(in, view, where);
}

TEST(EdgeSnap, AnEdgeGoesWhereThePictureHasIt) {
    for (const int unknown : {0, 2})
        for (int too = -2; too <= 2; ++too) {
            const InverseDepthField out = snapped(field(too, unknown), picture());
            for (int y = 0; y < kPicture.height; ++y)
                for (int x = 0; x < kPicture.width; ++x) {
                    const auto i = static_cast<std::size_t>(y) * kPicture.width + x;
                    ASSERT_TRUE(out.isKnown(i));
                    ASSERT_NEAR(out.rho[i], x < kEdge ? 2 : 0.5, 1e-4)
                        << x << "," << y << " off " << too << " gap " << unknown;
                }
        }
}

TEST(EdgeSnap, ASlopeStaysAsItIs) {
    InverseDepthField in(kPicture);
    for (std::size_t i = 0; i < in.rho.size(); ++i) {
        in.rho[i] = 1 + 0.004F * static_cast<float>(i % 64);
        in.variance[i] = 1e-6F;
    }
    const InverseDepthField out = snapped(in, picture());
    EXPECT_EQ(out.rho, in.rho);
    EXPECT_EQ(out.filled, in.filled);
}

TEST(EdgeSnap, WhatWasNotMeasuredIsMarked) {
    const InverseDepthField out = snapped(field(0, 5), picture());
    EXPECT_EQ(out.filled[24UL * 64 + kEdge + 2], 1);
    EXPECT_EQ(out.filled[24UL * 64 + 5], 0);
}

TEST(EdgeSnap, NothingComesFromNothing) {
    const InverseDepthField out = snapped(InverseDepthField(kPicture), picture());
    for (std::size_t i = 0; i < out.rho.size(); ++i)
        EXPECT_FALSE(out.isKnown(i));
}

TEST(EdgeSnap, OnlyTheRegionIsWorkedOn) {
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
