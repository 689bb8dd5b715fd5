#include "hal/device/picture_layout.h"

#include <gtest/gtest.h>

#include <array>
#include <gmock/gmock.h>
#include <stdexcept>
#include <vector>

namespace mfar {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class PictureLayoutTest : public testing::Test {
protected:
    [[nodiscard]] std::size_t at(const std::uint8_t* p) const {
        return static_cast<std::size_t>(p - memory_.data());
    }
    std::vector<std::uint8_t> memory_ = std::vector<std::uint8_t>(100'000);
};

TEST_F(PictureLayoutTest, PlanesInOneBufferFollowEachOther) {
    const PlaneBytes all{memory_.data(), memory_.size()};
    const ImageView nv12 = layOut({{64, 48}, PixelFormat::Nv12, 80}, {&all, 1});
    EXPECT_EQ(nv12.stride, 80U);
    EXPECT_EQ(at(nv12.chroma[0].data), 80U * 48);
    EXPECT_EQ(nv12.chroma[0].stride, 80U);
    const ImageView yuv = layOut({{64, 48}, PixelFormat::Yuv420, 80}, {&all, 1});
    EXPECT_EQ(at(yuv.chroma[0].data), 80U * 48);
    EXPECT_EQ(at(yuv.chroma[1].data), 80U * 48 + 40U * 24);
    EXPECT_EQ(yuv.chroma[1].stride, 40U);
}

TEST_F(PictureLayoutTest, SeparatePlanesKeepTheirLayout) {
    const std::array<PlaneBytes, 3> planes{PlaneBytes{&memory_[50'000], 80 * 48},
                                           PlaneBytes{&memory_[0], 40 * 24},
                                           PlaneBytes{&memory_[9'000], 40 * 24}};
    const ImageView yuv = layOut({{64, 48}, PixelFormat::Yuv420, 80}, planes);
    EXPECT_EQ(at(yuv.data), 50'000U);
    EXPECT_EQ(at(yuv.chroma[0].data), 0U);
    EXPECT_EQ(at(yuv.chroma[1].data), 9'000U);
}

TEST_F(PictureLayoutTest, APackedPictureKeepsItsFormatMatrixAndRange) {
    const PlaneBytes all{memory_.data(), memory_.size()};
    const ImageView view =
        layOut({{64, 48}, PixelFormat::Yuyv, 128, YuvMatrix::Bt709, YuvRange::Full}, {&all, 1});
    EXPECT_EQ(view.matrix, YuvMatrix::Bt709);
    EXPECT_EQ(view.range, YuvRange::Full);
    EXPECT_EQ(view.format, PixelFormat::Yuyv);
    EXPECT_EQ(view.chroma[0].data, nullptr);
}

TEST_F(PictureLayoutTest, TooSmallMemoryIsRefused) {
    struct Case {
        PixelFormat format;
        std::size_t stride;
        std::size_t bytes;
    };
    // The last row needs no padding.
    for (const Case& c :
         {Case{PixelFormat::Nv12, 80, 80 * 48 + 80 * 23 + 64},
          Case{PixelFormat::Yuv420, 80, 80 * 48 + 40 * 24 + 40 * 23 + 32},
          Case{PixelFormat::Yuyv, 140, 140 * 47 + 128}, Case{PixelFormat::Bgra8, 256, 256 * 48}}) {
        const PictureLayout layout{{64, 48}, c.format, c.stride};
        EXPECT_EQ(leastBytes(layout), c.bytes);
        const PlaneBytes enough{memory_.data(), c.bytes};
        const PlaneBytes less{memory_.data(), c.bytes - 1};
        EXPECT_NO_THROW((void)layOut(layout, {&enough, 1}));
        EXPECT_THAT([&] { (void)layOut(layout, {&less, 1}); },
                    ThrowsMessage<std::runtime_error>(HasSubstr("a picture needs")));
    }
}

TEST_F(PictureLayoutTest, ImpossibleLayoutsAreRefused) {
    const PlaneBytes all{memory_.data(), memory_.size()};
    EXPECT_THROW((void)layOut({{64, 48}, PixelFormat::Yuyv, 127}, {&all, 1}), std::runtime_error);
    EXPECT_THROW((void)layOut({{0, 48}, PixelFormat::Nv12, 64}, {&all, 1}), std::runtime_error);
    EXPECT_THROW((void)layOut({{64, -2}, PixelFormat::Nv12, 64}, {&all, 1}), std::runtime_error);
    const std::array<PlaneBytes, 2> two{all, all};
    EXPECT_THROW((void)layOut({{64, 48}, PixelFormat::Yuv420, 64}, two), std::runtime_error);
    EXPECT_THROW((void)layOut({{64, 48}, PixelFormat::Nv12, 64}, {}), std::runtime_error);
    const PlaneBytes none{nullptr, memory_.size()};
    EXPECT_THROW((void)layOut({{64, 48}, PixelFormat::Nv12, 64}, {&none, 1}), std::runtime_error);
}

}  // namespace
}  // namespace mfar
