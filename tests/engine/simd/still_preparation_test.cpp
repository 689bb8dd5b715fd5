#include "base/image_layout.h"
#include "pipeline/simd/still_preparation.h"
#include "pipeline/superres/still_scale.h"
#include "tests/engine/simd/detail_case.h"
#include "tests/oracle/still.h"

#include <gtest/gtest.h>

namespace mfar::simd {
namespace {

using twin::Grey;

std::vector<std::uint8_t> mixedBytes(std::size_t count, unsigned seed, int smooth) {
    std::vector<std::uint8_t> out(count);
    std::uint32_t state = seed;
    double value = 128;
    for (std::uint8_t& byte : out) {
        state = state * 1664525U + 1013904223U;
        value += (static_cast<double>(state >> 24) - value) / smooth;
        byte = static_cast<std::uint8_t>(value);
    }
    return out;
}

Grey lumaOf(const ImageView& rgba) {
    return twin::greyOf(rgba.size, [&](int x, int y) {
        const std::uint8_t* t = rgba.data + y * rgba.stride + 4 * x;
        return 0.299 * t[0] + 0.587 * t[1] + 0.114 * t[2];
    });
}

struct Still {
    Still(Size video, Size size, Size output, int threads = 2)
        : rig(idealRig(video, size)), preparation(rig, output, std::make_shared<Workers>(threads)) {
    }
    StereoRig rig;
    StillPreparation preparation;
};

struct TestPicture {
    explicit TestPicture(Size size, int smooth = 2)
        : bytes(mixedBytes(4UL * size.width * size.height, 7, smooth)),
          view{bytes.data(), size, 4UL * size.width, PixelFormat::Rgba8} {}
    std::vector<std::uint8_t> bytes;
    ImageView view;
};

TEST(StillPreparation, LumaMatchesTheOracleAtAnySize) {
    struct Sizes {
        Size video, still, output;
    };
    for (const auto& [video, still, output] :
         {Sizes{{50, 35}, {200, 140}, {200, 140}}, Sizes{{53, 37}, {201, 133}, {400, 300}},
          Sizes{{16, 16}, {17, 19}, {64, 64}}, Sizes{{160, 120}, {100, 75}, {320, 240}},
          Sizes{{33, 20}, {700, 424}, {700, 424}}}) {
        Still s(video, still, output);
        const TestPicture picture(still);
        s.preparation.set(picture.view);
        EXPECT_EQ(s.preparation.rig().still.size, still);
        EXPECT_LE(twin::worst(lumaOf(picture.view), s.preparation.luma()), 1);
    }
}

TEST(StillPreparation, StillFinerThanTheOutputIsReducedFirst) {
    const Size still{300, 225};
    Still s({80, 60}, still, {100, 75});
    s.preparation.set(TestPicture(still).view);
    EXPECT_EQ(s.preparation.rig().still.size, (Size{140, 105}));
    EXPECT_EQ(s.preparation.pairs().size, (Size{140, 105}));
    EXPECT_EQ(s.preparation.luma().size, still);
}

TEST(StillPreparation, PairsContainAPixelAndThePixelBelow) {
    for (const auto& [output, neighbours] : {std::pair{Size{131, 97}, 0.08}, {Size{50, 37}, 0.0}}) {
        Still s({40, 30}, {131, 97}, output);
        const TestPicture picture({131, 97});
        s.preparation.set(picture.view);
        const StillPairs pairs = s.preparation.pairs();
        const Size size = s.preparation.rig().still.size;
        ASSERT_EQ(pairs.size, size);
        Grey luma = lumaOf(picture.view);
        if (size != luma.size) luma = twin::reduced(luma, size);
        const Grey wanted = twin::raised(luma, neighbours);
        const auto at = [&](int x, int y) { return std::clamp(wanted.at(x, y), 0.0, 255.0); };
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                const int pair = pairs.data[y * pairs.pitch + x];
                ASSERT_NEAR(pair & 255, at(x, y), 2.2) << x << " " << y;
                const int below = std::min(y + 1, size.height - 1);
                ASSERT_EQ(pair >> 8, pairs.data[below * pairs.pitch + x] & 255) << x << " " << y;
            }
    }
}

TEST(StillPreparation, PairsAreWithoutNoiseButLumaIsUnchanged) {
    constexpr double kNoise = 4;
    for (const auto& [output, neighbours] : {std::pair{Size{131, 97}, 0.08}, {Size{50, 37}, 0.0}}) {
        Still s({40, 30}, {131, 97}, output);
        const TestPicture picture({131, 97}, 12);
        s.preparation.set(picture.view, {}, true, kNoise);
        EXPECT_LE(twin::worst(lumaOf(picture.view), s.preparation.luma()), 1);
        const StillPairs pairs = s.preparation.pairs();
        Grey luma = lumaOf(picture.view);
        if (pairs.size != luma.size) luma = twin::reduced(luma, pairs.size);
        const Grey wanted = twin::raised(
            twin::quiet(luma, quietVariance(kNoise, {131, 97}, pairs.size)), neighbours);
        double removed = 0;
        for (int y = 0; y < pairs.size.height; ++y)
            for (int x = 0; x < pairs.size.width; ++x) {
                const int level = pairs.data[y * pairs.pitch + x] & 255;
                ASSERT_NEAR(level, std::clamp(wanted.at(x, y), 0.0, 255.0), 3) << x << " " << y;
                removed += std::abs(wanted.at(x, y) - luma.at(x, y));
            }
        EXPECT_GT(removed, 0.5 * pairs.size.width * pairs.size.height);
    }
}

TEST(QuietVariance, IsFourTimesTheVarianceOfTheNoiseThatTheReductionLeaves) {
    EXPECT_EQ(quietVariance(0, {400, 300}, {400, 300}), 0);
    EXPECT_EQ(quietVariance(0.7, {400, 300}, {400, 300}), 0) << "so little noise is not visible";
    EXPECT_EQ(quietVariance(std::nan(""), {400, 300}, {400, 300}), 0);
    EXPECT_FLOAT_EQ(quietVariance(3, {400, 300}, {400, 300}), 36);
    EXPECT_FLOAT_EQ(quietVariance(3, {400, 300}, {200, 150}), 4);
    EXPECT_FLOAT_EQ(quietVariance(50, {400, 300}, {400, 300}), 576)
        << "noise above 12 grey levels must count as texture";
}

TEST(StillPreparation, TheToneCurveChangesLumaAndPairsButNotThePicture) {
    StillTone tone;
    for (std::size_t i = 0; i < tone.levels.size(); ++i)
        tone.levels[i] = static_cast<std::uint8_t>(40 + i / 2);
    for (const Size output : {Size{131, 97}, Size{50, 37}}) {
        Still plain({40, 30}, {131, 97}, output), changed({40, 30}, {131, 97}, output);
        const TestPicture picture({131, 97});
        plain.preparation.set(picture.view);
        changed.preparation.set(picture.view, tone);
        const auto before = plain.preparation.luma(), after = changed.preparation.luma();
        const StillPairs pairs = plain.preparation.pairs(), toned = changed.preparation.pairs();
        for (int y = 0; y < 97; ++y)
            for (int x = -1; x <= 131; ++x)
                ASSERT_EQ(after[y][x], tone.levels[before[y][x]]) << x << " " << y;
        for (int y = 0; y < pairs.size.height; ++y)
            for (int x = 0; x < pairs.size.width; ++x) {
                const int level = pairs.data[y * pairs.pitch + x] & 255;
                if (level == 0 || level == 255) continue;  // may be clamped
                ASSERT_NEAR(toned.data[y * toned.pitch + x] & 255, 40 + level / 2.0, 2.5)
                    << x << " " << y;
            }
        EXPECT_EQ(changed.preparation.picture()[5][7], plain.preparation.picture()[5][7]);
    }
}

TEST(StillPreparation, ConstantStillStaysConstant) {
    for (const int level : {0, 90, 255}) {
        for (const Size output : {Size{200, 140}, Size{60, 42}}) {
            Still s({50, 35}, {200, 140}, output);
            TestPicture picture({200, 140});
            std::ranges::fill(picture.bytes, static_cast<std::uint8_t>(level));
            s.preparation.set(picture.view);
            const StillPairs pairs = s.preparation.pairs();
            for (int y = 0; y < pairs.size.height; ++y)
                for (int x = 0; x < pairs.size.width; ++x)
                    ASSERT_EQ(pairs.data[y * pairs.pitch + x], 0x101 * level);
        }
    }
}

/// Luma of a Y U V picture, computed from its R G B values before they are clamped. Chroma is
/// interpolated between its samples.
Grey lumaOfYuv(const ImageView& p) {
    const YuvToRgb rows = yuvToRgb(p.matrix, p.range);
    const bool packed = p.format == PixelFormat::Yuyv, pairs = p.format == PixelFormat::Nv12;
    const Size half{p.size.width / 2, packed ? p.size.height : p.size.height / 2};
    const auto chroma = [&](int which) {
        return twin::greyOf(half, [&, which](int x, int y) {
            if (packed) return double(p.data[y * p.stride + 4 * x + 1 + 2 * which]);
            if (pairs) return double(p.chroma[0].data[y * p.chroma[0].stride + 2 * x + which]);
            return double(p.chroma[which].data[y * p.chroma[which].stride + x]);
        });
    };
    const Grey u = chroma(0), v = chroma(1);
    return twin::greyOf(p.size, [&](int x, int y) {
        const double at = packed ? y : twin::centre(y, half.height, p.size.height);
        const double cx = twin::centre(x, half.width, p.size.width);
        const double yuv[] = {double(p.data[y * p.stride + (packed ? 2 * x : x)]),
                              u.bilinear(cx, at), v.bilinear(cx, at)};
        double sum = 0;
        const double weights[] = {0.299, 0.587, 0.114};
        for (int i = 0; i < 3; ++i)
            sum += weights[i] *
                   (rows[i][0] * yuv[0] + rows[i][1] * yuv[1] + rows[i][2] * yuv[2] + rows[i][3]);
        return std::clamp(sum, 0.0, 255.0);
    });
}

TEST(StillPreparation, CameraFormatsGiveTheLumaOfTheirColours) {
    const Size size{118, 74};
    for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420})
        for (const YuvMatrix matrix : {YuvMatrix::Bt601, YuvMatrix::Bt709})
            for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
                const auto bytes = mixedBytes(packedBytes(format, size), 3, 3);
                ImageView view = packedView(bytes.data(), size, format);
                view.matrix = matrix;
                view.range = range;
                Still s({40, 25}, size, size);
                s.preparation.set(view);
                EXPECT_LE(twin::worst(lumaOfYuv(view), s.preparation.luma()), 1)
                    << nameOf(format) << static_cast<int>(matrix) << static_cast<int>(range);
            }
}

TEST(StillPreparation, GreyAndBgrStillsAreRead) {
    Still s({40, 25}, {90, 60}, {90, 60});
    const auto bytes = mixedBytes(4UL * 90 * 60, 3, 3);
    s.preparation.set({bytes.data(), {90, 60}, 90, PixelFormat::Gray8});
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 90; ++x)
            ASSERT_EQ(s.preparation.luma()[y][x], bytes[y * 90 + x]);
    s.preparation.set({bytes.data(), {90, 60}, 360, PixelFormat::Bgra8});
    const Grey wanted = twin::greyOf({90, 60}, [&](int x, int y) {
        const std::uint8_t* t = bytes.data() + y * 360 + 4 * x;
        return 0.114 * t[0] + 0.587 * t[1] + 0.299 * t[2];
    });
    EXPECT_LE(twin::worst(wanted, s.preparation.luma()), 1);
}

TEST(StillPreparation, PictureKeepsColoursAndOutlivesItsSource) {
    Still s({40, 25}, {91, 60}, {91, 60});
    auto picture = std::make_unique<TestPicture>(Size{91, 60});
    s.preparation.set(picture->view);
    const std::vector<std::uint8_t> bytes = picture->bytes;
    picture.reset();
    const Rows<const std::uint32_t> got = s.preparation.picture();
    ASSERT_EQ(got.size, (Size{91, 60}));
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 91; ++x)
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(got[y][x] >> (8 * c) & 255, c < 3 ? bytes[4 * (y * 91 + x) + c] : 255);
}

TEST(StillPreparation, IfColoursAreNotKeptThePictureIsGrey) {
    Still s({40, 25}, {90, 60}, {90, 60});
    s.preparation.set(TestPicture({90, 60}).view, {}, false);
    const Rows<const std::uint32_t> got = s.preparation.picture();
    for (int x = 0; x < 90; ++x)
        ASSERT_EQ(got[7][x], 0xff000000U | 0x10101U * s.preparation.luma()[7][x]);
}

TEST(StillPreparation, ReducedPictureMatchesTheOracle) {
    Still s({80, 60}, {300, 225}, {100, 75});
    const TestPicture picture({300, 225});
    s.preparation.set(picture.view);
    const Rows<const std::uint32_t> got = s.preparation.picture();
    ASSERT_EQ(got.size, s.preparation.rig().still.size);
    for (int c = 0; c < 3; ++c) {
        const Grey channel = twin::greyOf(
            {300, 225}, [&](int x, int y) { return double(picture.bytes[4 * (y * 300 + x) + c]); });
        const Grey wanted = twin::reduced(channel, got.size);
        for (int y = 0; y < got.size.height; ++y)
            for (int x = 0; x < got.size.width; ++x)
                ASSERT_NEAR(got[y][x] >> (8 * c) & 255, wanted.at(x, y), 0.51);
    }
}

TEST(StillPreparation, ResultsDoNotDependOnTheNumberOfThreads) {
    const TestPicture picture({200, 140});
    Still one({50, 35}, {200, 140}, {200, 140}, 1), four({50, 35}, {200, 140}, {200, 140}, 4);
    one.preparation.set(picture.view);
    four.preparation.set(picture.view);
    const StillPairs a = one.preparation.pairs(), b = four.preparation.pairs();
    for (int y = 0; y < 140; ++y)
        ASSERT_TRUE(
            std::equal(a.data + y * a.pitch, a.data + y * a.pitch + 200, b.data + y * b.pitch));
}

}  // namespace
}  // namespace mfar::simd
