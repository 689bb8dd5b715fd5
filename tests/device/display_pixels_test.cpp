#include "hal/device/display_pixels.h"

#include <gtest/gtest.h>

#include <vector>

namespace mfar {
namespace {

const PixelLayout kXrgb{32, {16, 8}, {8, 8}, {0, 8}, {0, 0}};
const PixelLayout kRgbx{32, {24, 8}, {16, 8}, {8, 8}, {0, 8}};
const PixelLayout kRgb888{24, {16, 8}, {8, 8}, {0, 8}, {0, 0}};
const PixelLayout kBgr888{24, {0, 8}, {8, 8}, {16, 8}, {0, 0}};
const PixelLayout kRgb565{16, {11, 5}, {5, 6}, {0, 5}, {0, 0}};
const PixelLayout kArgb1555{16, {10, 5}, {5, 5}, {0, 5}, {15, 1}};

std::vector<std::uint8_t> packed(const PixelLayout& layout, std::size_t stride) {
    const std::vector<std::uint8_t> bgra{0x12, 0x34, 0x56, 0xff, 0xff, 0x00, 0x80, 0xff,  //
                                         0x00, 0xff, 0x00, 0xff, 0x07, 0x03, 0xf8, 0xff};
    std::vector<std::uint8_t> out(2 * stride, 0xee);
    packPixels({bgra.data(), {2, 2}, 8, PixelFormat::Bgra8}, layout, out.data(), stride);
    return out;
}

using Bytes = std::vector<std::uint8_t>;

TEST(PixelLayout, PacksThirtyTwoBitsInEitherChannelOrder) {
    EXPECT_EQ(packed(kXrgb, 8), (Bytes{0x12, 0x34, 0x56, 0xff, 0xff, 0x00, 0x80, 0xff,  //
                                       0x00, 0xff, 0x00, 0xff, 0x07, 0x03, 0xf8, 0xff}));
    EXPECT_EQ(packed(kRgbx, 8), (Bytes{0xff, 0x12, 0x34, 0x56, 0xff, 0xff, 0x00, 0x80,  //
                                       0xff, 0x00, 0xff, 0x00, 0xff, 0x07, 0x03, 0xf8}));
}

TEST(PixelLayout, PacksTwentyFourBitsAndLeavesThePaddingAlone) {
    EXPECT_EQ(packed(kRgb888, 7), (Bytes{0x12, 0x34, 0x56, 0xff, 0x00, 0x80, 0xee,  //
                                         0x00, 0xff, 0x00, 0x07, 0x03, 0xf8, 0xee}));
    EXPECT_EQ(packed(kBgr888, 6), (Bytes{0x56, 0x34, 0x12, 0x80, 0x00, 0xff,  //
                                         0x00, 0xff, 0x00, 0xf8, 0x03, 0x07}));
}

TEST(PixelLayout, PacksTheUppermostBitsIntoSixteenBits) {
    // 0x56 0x34 0x12 -> 01010 001101 00010; 0x80 0x00 0xff -> 10000 000000 11111
    EXPECT_EQ(packed(kRgb565, 5), (Bytes{0xa2, 0x51, 0x1f, 0x80, 0xee,  //
                                         0xe0, 0x07, 0x00, 0xf8, 0xee}));
    // the alpha bit must be 1 (opaque)
    EXPECT_EQ(packed(kArgb1555, 4), (Bytes{0xc2, 0xa8, 0x1f, 0xc0, 0xe0, 0x83, 0x00, 0xfc}));
}

// Pictures on the host (RGBA) and on the GPU (BGRA) must be packed equally, even if the width is
// not a multiple of the vector length. Alpha is ignored.
TEST(PixelLayout, HostRowsPackLikeGpuPictures) {
    constexpr Size kSize{37, 3};
    Bytes bgra(4UL * kSize.width * kSize.height, 255), rgba(bgra.size());
    for (std::size_t i = 0; i < bgra.size(); i += 4) {
        for (std::size_t k = 0; k < 3; ++k)
            bgra[i + k] = rgba[i + 2 - k] = static_cast<std::uint8_t>((i + k) * 7 + i / 5);
        rgba[i + 3] = static_cast<std::uint8_t>(i);
    }
    for (const PixelLayout& layout : {kXrgb, kRgbx, kRgb888, kBgr888, kRgb565, kArgb1555}) {
        const std::size_t stride = kSize.width * layout.bytes() + 3;
        Bytes fromGpu(kSize.height * stride, 0xee), fromHost = fromGpu;
        packPixels({bgra.data(), kSize, 4UL * kSize.width, PixelFormat::Bgra8}, layout,
                   fromGpu.data(), stride);
        packPixels({rgba.data(), kSize, 4UL * kSize.width, PixelFormat::Rgba8}, layout,
                   fromHost.data(), stride);
        EXPECT_EQ(fromHost, fromGpu) << layout.bits << " bits, red at " << layout.red.offset;
    }
}

TEST(PixelLayout, ChannelsOutsideTheBitsOfAPixelAreRefused) {
    for (const PixelLayout& good : {kXrgb, kRgbx, kRgb888, kBgr888, kRgb565, kArgb1555})
        EXPECT_TRUE(good.valid());
    const auto broken = [](auto change) {
        PixelLayout layout = kRgb565;
        change(layout);
        return layout.valid();
    };
    EXPECT_FALSE(broken([](PixelLayout& l) { l.bits = 8; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.bits = 15; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.red.offset = 12; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.green.offset = -1; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.blue.length = 0; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.blue.length = 9; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.blue.length = -3; }));
    EXPECT_FALSE(broken([](PixelLayout& l) { l.alpha = {16, 1}; }));
}

}  // namespace
}  // namespace mfar
