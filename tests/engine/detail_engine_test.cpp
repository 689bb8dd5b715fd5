#include "tests/engine/detail_drawing.h"

namespace mfar {
namespace {

INSTANTIATE_TEST_SUITE_P(Engines, DetailEngineTest, DetailEngineTest::everyPair(),
                         DetailEngineTest::nameOfPair);

TEST_P(DetailEngineTest, WholeFrameMatchesTheOracleAtAnySize) {
    const bool shaders = GetParam().detail == EngineKind::Gles;
    for (const auto& [video, stillSize, output] : simd::kSizes) {
        const DetailCase frame = withRoom(DetailCase(video, stillSize));
        Drawing drawing(GetParam(), frame, output);
        const Rows<const std::uint32_t> drawn = drawing.draw(frame);
        simd::Wanted wanted(frame, output, simd::kDetail, true);
        if (shaders) wanted.seeStill();
        const twin::Grey still = drawing.luma();
        double squares = 0;
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double error = channel(drawn, x, y, c) - wanted.withStill(x, y, c, still);
                    // Tolerance: shaders keep 8 bits after each pass.
                    ASSERT_LE(std::abs(error), shaders ? 3.5 : 0.8)
                        << output.width << ": " << x << " " << y << " " << c;
                    squares += error * error;
                }
        const double rms = std::sqrt(squares / (3.0 * output.width * output.height));
        EXPECT_LE(rms, shaders ? 0.75 : 0.33) << output.width;
    }
}

/// Expects that each channel of each pixel equals `of(x, y, channel)` within a tolerance of `most`.
template <class F>
void expectPicture(Rows<const std::uint32_t> drawn, F&& of, double most) {
    for (int y = 0; y < drawn.size.height; ++y)
        for (int x = 0; x < drawn.size.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(channel(drawn, x, y, c), of(x, y, c), most)
                    << drawn.size.width << ": " << x << " " << y << " " << c;
}

// Tolerance [grey levels]: luma is rounded to 1/8 grey level, and so are the limits between which
// twin::residualAt() clamps the enlarged luma.
constexpr double kLearnedError = 1.3;

// Shaders interpolate the still with weights of 8 bits, at positions in half precision.
double learnedErrorWithStill(bool shaders) {
    return shaders ? (kLearnedError + 1.2) * roundingFactor() : kLearnedError;
}

TEST_P(DetailEngineTest, FramesEnlargedByFiltersMatchTheOracleWithAndWithoutAStill) {
    const bool shaders = GetParam().detail == EngineKind::Gles;
    const simd::DetailOptions options{SuperResMode::Detail, true, false, false, &simd::evenBank()};
    for (const auto& [video, stillSize, output] : simd::kSizes) {
        if (output.width > 1000) continue;  // large outputs take too long
        const DetailCase frame = withRoom(DetailCase(video, stillSize));
        Drawing drawing(GetParam(), frame, output);
        simd::Wanted alone(frame, output, options, false), wanted(frame, output, options, true);
        if (shaders) wanted.seeStill();
        expectPicture(
            drawing.drawWithoutStill(frame, options.learned),
            [&](int x, int y, int c) { return alone.enlarged(x, y, c); }, kLearnedError);
        const twin::Grey still = drawing.luma();
        expectPicture(
            drawing.draw(frame, options.learned),
            [&](int x, int y, int c) { return wanted.withStill(x, y, c, still); },
            learnedErrorWithStill(shaders));
    }
}

TEST_P(DetailEngineTest, FramesWithGuidanceMatchTheOracle) {
    const bool shaders = GetParam().detail == EngineKind::Gles;
    const simd::DetailOptions options{SuperResMode::Detail, true, false, false,
                                      &simd::guidedBank()};
    for (const auto& [video, stillSize, output] : simd::kSizes) {
        if (output.width > 1000) continue;
        const DetailCase frame = withRoom(DetailCase(video, stillSize));
        Drawing drawing(GetParam(), frame, output);
        simd::Wanted wanted(frame, output, options, true);
        if (shaders) wanted.seeStill();
        const twin::Grey still = drawing.luma();
        expectPicture(
            drawing.draw(frame, options.learned),
            [&](int x, int y, int c) { return wanted.withStill(x, y, c, still); },
            learnedErrorWithStill(shaders));
    }
}

TEST_P(DetailEngineTest, TilesWithoutStructureAreNotEnlargedByFilters) {
    const Size output{576, 432};
    DetailCase frame = withRoom(DetailCase({160, 120}, {400, 300}));
    for (std::size_t i = 0; i < frame.work.flags.size(); ++i)
        frame.work.flags[i].matched = i % 3 == 0;
    const simd::DetailOptions options{SuperResMode::Detail, true, false, false, &simd::evenBank()};
    const simd::Wanted with(frame, output, options, false),
        without(frame, output, simd::kDetail, false);
    Drawing drawing(GetParam(), frame, output);
    expectPicture(
        drawing.drawWithoutStill(frame, options.learned),
        [&](int x, int y, int c) {
            const int tile =
                simd::tileAt(y, 120, 432) * frame.work.tiles.width + simd::tileAt(x, 160, 576);
            return (tile % 3 == 0 ? with : without).enlarged(x, y, c);
        },
        kLearnedError);
}

TEST_P(DetailEngineTest, ChangedOrRemovedFiltersTakeEffectInTheNextFrame) {
    const Size video{53, 37}, output{191, 133};
    const DetailCase frame = withRoom(DetailCase(video, {200, 140}));
    const std::array<const FilterBank*, 6> banks{&simd::evenBank(),    &simd::guidedBank(),
                                                 &FilterBank::prior(), nullptr,
                                                 &simd::guidedBank(),  nullptr};
    Drawing drawing(GetParam(), frame, output);
    for (std::size_t i = 0; i < banks.size(); ++i) {
        Drawing other(GetParam(), frame, output);
        const Rows<const std::uint32_t> a = drawing.draw(frame, banks[i]),
                                        b = other.draw(frame, banks[i]);
        for (int y = 0; y < output.height; ++y)
            ASSERT_TRUE(std::equal(a[y], a[y] + output.width, b[y])) << i << ": row " << y;
    }
}

/// Another still for the same video: darker, with other look-ups, and with weight where the first
/// still has none.
DetailCase secondOf(DetailCase frame) {
    for (std::uint8_t& byte : frame.stillPixels)
        byte = static_cast<std::uint8_t>(byte * 4 / 5);
    for (int y = 0; y < frame.cells.height; ++y)
        for (int x = 0; x < frame.cells.width; ++x) {
            const std::size_t i = std::size_t(y) * frame.cells.width + x;
            const auto px = static_cast<float>(x), py = static_cast<float>(y);
            const float weight =
                std::clamp(0.5F + 0.6F * std::sin(0.26F * px - 0.31F * py), 0.0F, 1.1F);
            frame.lookUps[i] = {frame.lookUps[i].x + 2.5F, frame.lookUps[i].y - 1.75F, weight,
                                0.9F};
            frame.weighed[i].weight = weight;
            frame.trust[i] = {0.5F * weight, 0.9F, 0.9F, weight > 0.3F ? 0.0F : 1.0F};
        }
    return frame;
}

TEST_P(DetailEngineTest, OnlyChangedTilesShowASecondStill) {
    const Size video{160, 120}, stillSize{400, 300}, output{576, 432};
    const DetailCase whole = withRoom(DetailCase(video, stillSize)),
                     part = withRoom(DetailCase(video, stillSize, 0.4));
    for (const FilterBank* filters : {&FilterBank::prior(), &simd::guidedBank()}) {
        Drawing all(GetParam(), whole, output), some(GetParam(), whole, output);
        const Rows<const std::uint32_t> wanted = all.drawBoth(whole, secondOf(whole), filters);
        const std::vector<std::uint32_t> one = copyOf(some.draw(whole, filters));
        const Rows<const std::uint32_t> drawn = some.drawBoth(part, secondOf(part), filters);
        int differs = 0;
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x) {
                const bool changed = part.work
                                         .at(simd::tileAt(x, video.width, output.width),
                                             simd::tileAt(y, video.height, output.height))
                                         .changed != 0;
                const std::uint32_t before = one[std::size_t(y) * output.width + x];
                ASSERT_EQ(drawn[y][x], changed ? wanted[y][x] : before) << x << " " << y;
                differs += wanted[y][x] != before ? 1 : 0;
            }
        EXPECT_GT(differs, output.width * output.height / 10)
            << "the second still must change the picture";
        EXPECT_GT(some.summary().second, 0);
        EXPECT_LT(some.summary().second, all.summary().second);
        // A frame with only one still must show nothing of the second still.
        EXPECT_EQ(copyOf(some.draw(whole, filters)), one);
    }
}

using DetailEngines = GlTest;

/// `most`: limit of the difference of any channel. `rms`: limit of the root mean square of all
/// differences. Both in grey levels.
void expectNear(Rows<const std::uint32_t> a, Rows<const std::uint32_t> b, double most, double rms) {
    double squares = 0;
    for (int y = 0; y < a.size.height; ++y)
        for (int x = 0; x < a.size.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double off = channel(a, x, y, c) - channel(b, x, y, c);
                ASSERT_LE(std::abs(off), most) << a.size.width << ": " << x << " " << y;
                squares += off * off;
            }
    EXPECT_LE(std::sqrt(squares / (3.0 * a.size.width * a.size.height)), rms) << a.size.width;
}

// Detail is the still minus its mean over each video pixel. The SIMD kernels compute this mean from
// the warped still of the output's size, the shaders from the still itself. The two means agree
// only if the output is clearly finer than the video. Therefore, outputs less than 1.5 times as
// wide as the video are left out.
void expectTheSamePicture(const FilterBank* filters, double most, double rms) {
    for (const auto& [video, stillSize, output] : simd::kSizes) {
        if (2 * output.width < 3 * video.width) continue;
        const DetailCase frame = withRoom(DetailCase(video, stillSize));
        Drawing gles({EngineKind::Gles, EngineKind::Simd}, frame, output),
            simd({EngineKind::Simd, EngineKind::Simd}, frame, output);
        expectNear(gles.draw(frame, filters), simd.draw(frame, filters), most, rms);
    }
}

TEST_F(DetailEngines, BothEnginesDrawTheSamePicture) {
    // Where the flow jumps, the warped still has an edge, and the two means blur it differently.
    expectTheSamePicture(nullptr, 5, 0.85);
}

TEST_F(DetailEngines, BothEnginesDrawTheSamePictureWithLearnedFilters) {
    expectTheSamePicture(&FilterBank::prior(), 4, 0.6);
}

TEST_F(DetailEngines, BothEnginesDrawTheSamePictureWithGuidance) {
    expectTheSamePicture(&simd::guidedBank(), 4, 0.6);
}

TEST_F(DetailEngines, BothEnginesShowASecondStillAlike) {
    const Size output{576, 432};
    const DetailCase whole = withRoom(DetailCase({160, 120}, {400, 300}));
    for (const double share : {1.0, 0.4}) {
        const DetailCase frame = withRoom(DetailCase({160, 120}, {400, 300}, share));
        for (const EngineKind still : {EngineKind::Gles, EngineKind::Simd}) {
            Drawing gles({EngineKind::Gles, still}, frame, output),
                simd({EngineKind::Simd, still}, frame, output);
            (void)gles.draw(whole, &simd::guidedBank());
            (void)simd.draw(whole, &simd::guidedBank());
            expectNear(gles.drawBoth(frame, secondOf(frame), &simd::guidedBank()),
                       simd.drawBoth(frame, secondOf(frame), &simd::guidedBank()), 4, 0.6);
            EXPECT_EQ(gles.summary().second, simd.summary().second);
            EXPECT_EQ(gles.summary().tiles, simd.summary().tiles);
            EXPECT_NEAR(gles.summary().explained, simd.summary().explained, 1e-9);
        }
    }
}

}  // namespace
}  // namespace mfar
