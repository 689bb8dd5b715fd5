#include "hal/device/jpeg_decoder.h"
#include "tests/device/jpeg_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <turbojpeg.h>
#include <vector>

namespace mfar {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr Size kJpegSize{64, 48};

Bytes rgbRamp() {
    Bytes out;
    for (int y = 0; y < kJpegSize.height; ++y)
        for (int x = 0; x < kJpegSize.width; ++x)
            for (const int c : {60 + 2 * x, 200 - 2 * y, 90 + x + y})
                out.push_back(static_cast<std::uint8_t>(c));
    return out;
}

Bytes encoded(int subsampling) {
    return test::jpegOf(rgbRamp(), kJpegSize, subsampling);
}

/// Removes the Huffman tables. Many cameras omit the tables that the standard suggests.
Bytes withoutHuffmanTables(const Bytes& jpeg) {
    Bytes out(jpeg.begin(), jpeg.begin() + 2);
    std::size_t i = 2;
    while (i + 4 < jpeg.size() && jpeg[i + 1] != 0xda) {
        const std::size_t length = 2 + 256UL * jpeg[i + 2] + jpeg[i + 3];
        if (jpeg[i + 1] != 0xc4)
            out.insert(out.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(i),
                       jpeg.begin() + static_cast<std::ptrdiff_t>(i + length));
        i += length;
    }
    out.insert(out.end(), jpeg.begin() + static_cast<std::ptrdiff_t>(i), jpeg.end());
    return out;
}

/// Expects the colours of the ramp in BT.601, full range. The chroma that 2x2 pixels share must be
/// the ramp's chroma at their centre.
void expectRamp(const ImageView& view) {
    ASSERT_EQ(view.size, kJpegSize);
    ASSERT_EQ(view.format, PixelFormat::Yuv420);
    EXPECT_EQ(view.range, YuvRange::Full);
    EXPECT_EQ(view.matrix, YuvMatrix::Bt601);
    const auto at = [](double x, double y) {
        return std::array<double, 3>{60 + 2 * x, 200 - 2 * y, 90 + x + y};
    };
    for (int y = 0; y < kJpegSize.height; ++y)
        for (int x = 0; x < kJpegSize.width; ++x) {
            const auto [r, g, b] = at(x, y);
            ASSERT_NEAR(view.data[y * view.stride + x], 0.299 * r + 0.587 * g + 0.114 * b, 4);
        }
    for (int y = 0; y < kJpegSize.height / 2; ++y)
        for (int x = 0; x < kJpegSize.width / 2; ++x) {
            const auto [r, g, b] = at(2 * x + 0.5, 2 * y + 0.5);
            ASSERT_NEAR(view.chroma[0].data[y * view.chroma[0].stride + x],
                        128 - 0.168736 * r - 0.331264 * g + 0.5 * b, 3);
            ASSERT_NEAR(view.chroma[1].data[y * view.chroma[1].stride + x],
                        128 + 0.5 * r - 0.418688 * g - 0.081312 * b, 3);
        }
}

TEST(JpegDecoder, BothSubsamplingsThatCamerasUseAreDecoded) {
    JpegDecoder decoder(kJpegSize, 2);
    for (const int subsampling : {TJSAMP_420, TJSAMP_422}) {
        const auto frame = decoder.decode(encoded(subsampling), {5});
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->time().ns, 5);
        expectRamp(frame->view());
    }
}

TEST(JpegDecoder, MissingHuffmanTablesDefaultToTheStandardOnes) {
    const Bytes whole = encoded(TJSAMP_422), bare = withoutHuffmanTables(whole);
    ASSERT_LT(bare.size() + 300, whole.size());
    JpegDecoder decoder(kJpegSize, 1);
    const auto frame = decoder.decode(bare, {});
    ASSERT_TRUE(frame.has_value());
    expectRamp(frame->view());
}

TEST(JpegDecoder, GreyPicturesStayGrey) {
    JpegDecoder decoder(kJpegSize, 1);
    const auto frame = decoder.decode(encoded(TJSAMP_GRAY), {});
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(frame->view().format, PixelFormat::Gray8);
    EXPECT_NEAR(frame->view().data[0], 0.299 * 60 + 0.587 * 200 + 0.114 * 90, 4);
}

TEST(JpegDecoder, ExtraBytesBeforeTheEndMarkerAreHarmless) {
    Bytes jpeg = encoded(TJSAMP_420);
    jpeg.insert(jpeg.end() - 2, {0x11, 0x22, 0x33, 0x44});
    JpegDecoder decoder(kJpegSize, 1);
    const auto frame = decoder.decode(jpeg, {});
    ASSERT_TRUE(frame.has_value());
    expectRamp(frame->view());
}

TEST(JpegDecoder, DamagedPicturesAreDroppedAndReleaseTheirBuffer) {
    const Bytes jpeg = encoded(TJSAMP_422);
    JpegDecoder decoder(kJpegSize, 1);
    for (std::size_t bytes = 0; bytes < jpeg.size() - 40; bytes += 37)
        EXPECT_FALSE(decoder.decode({jpeg.data(), bytes}, {}).has_value()) << bytes;
    EXPECT_FALSE(decoder.decode(encoded(TJSAMP_444), {}).has_value());
    JpegDecoder other({kJpegSize.width, kJpegSize.height + 2}, 1);
    EXPECT_FALSE(other.decode(jpeg, {}).has_value()) << "a picture of another size must be refused";
    EXPECT_TRUE(decoder.decode(jpeg, {}).has_value());
}

TEST(JpegDecoder, WithAllBuffersLentNothingIsDecoded) {
    JpegDecoder decoder(kJpegSize, 1);
    const Bytes jpeg = encoded(TJSAMP_420);
    auto held = decoder.decode(jpeg, {});
    EXPECT_FALSE(decoder.isFull());
    EXPECT_FALSE(decoder.decode(jpeg, {}).has_value());
    EXPECT_TRUE(decoder.isFull());
    EXPECT_FALSE(decoder.decode({jpeg.data(), 2}, {}).has_value());
    EXPECT_FALSE(decoder.isFull())
        << "decode() failed because of the damage, not for lack of buffers";
    held.reset();
    EXPECT_TRUE(decoder.decode(jpeg, {}).has_value());
}

TEST(JpegDecoder, OddSizesAreRefused) {
    EXPECT_THROW(JpegDecoder({63, 48}, 1), std::invalid_argument);
    EXPECT_THROW(JpegDecoder({64, 47}, 1), std::invalid_argument);
    EXPECT_THROW(JpegDecoder({0, 0}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace mfar
