#include "base/workers.h"
#include "pipeline/engine/engine.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/simd/detail_oracle.h"

namespace mfar {
namespace {

using simd::DetailCase;

struct StepEngines {
    EngineKind detail, still;
};

class DetailEngineTest : public GlTest, public testing::WithParamInterface<StepEngines> {};
INSTANTIATE_TEST_SUITE_P(Engines, DetailEngineTest,
                         testing::Values(StepEngines{EngineKind::Gles, EngineKind::Gles},
                                         StepEngines{EngineKind::Gles, EngineKind::Simd},
                                         StepEngines{EngineKind::Simd, EngineKind::Gles},
                                         StepEngines{EngineKind::Simd, EngineKind::Simd}),
                         [](const auto& tested) {
                             return std::string(nameOf(tested.param.detail)) + "_still_" +
                                    std::string(nameOf(tested.param.still));
                         });

/// Reduces the contrast, so that no value leaves a byte's range when sharpening overshoots: shaders
/// would clamp it, but the oracle does not.
DetailCase withRoom(DetailCase frame) {
    for (std::vector<std::uint8_t>* pixels : {&frame.videoPixels, &frame.stillPixels})
        for (std::uint8_t& byte : *pixels)
            byte = static_cast<std::uint8_t>(51 + byte * 3 / 5);
    frame.video.take(frame.videoView());
    return frame;
}

class Drawing {
public:
    Drawing(const StepEngines& engines, const DetailCase& first, Size output)
        : setup_{first.rig, output, {}, std::make_shared<Workers>(2)},
          stillEngine_(engineOf(engines.still)), detailEngine_(engineOf(engines.detail)),
          still_(stillEngine_->still()), step_(detailEngine_->detail()),
          pictures_(still_->run(first.stillView(), SuperResMode::Detail, {})) {}

    Rows<const std::uint32_t> draw(const DetailCase& frame, const FilterBank* filters = nullptr) {
        const CellWeights weights = weightsOf(frame);
        const DetailStep::Matched matched{pictures_, weights};
        return draw(frame, &matched, filters);
    }
    Rows<const std::uint32_t> drawBoth(const DetailCase& frame, const DetailCase& second,
                                       const FilterBank* filters) {
        if (!secondStill_) secondStill_ = stillEngine_->still();
        const StillPictures& pictures =
            secondStill_->run(second.stillView(), SuperResMode::Detail, {});
        const CellWeights weights = weightsOf(frame), secondWeights = weightsOf(second);
        const DetailStep::Matched other{pictures, secondWeights},
            matched{pictures_, weights, &other};
        return draw(frame, &matched, filters);
    }
    [[nodiscard]] TileSummary summary() const { return step_->summary(); }
    Rows<const std::uint32_t> drawWithoutStill(const DetailCase& frame, const FilterBank* filters) {
        return draw(frame, nullptr, filters);
    }
    [[nodiscard]] twin::Grey luma() const {
        if (!pictures_.raised.isEmpty()) {
            const Rows<const std::uint8_t> raised = pictures_.raised.host();
            return twin::greyOf(raised.size, [&](int x, int y) { return double(raised[y][x]); });
        }
        const Rows<const std::uint16_t> pairs = pictures_.pairs.host();
        return twin::greyOf(pairs.size, [&](int x, int y) { return double(pairs[y][x] & 255); });
    }

private:
    Rows<const std::uint32_t> draw(const DetailCase& frame, const DetailStep::Matched* matched,
                                   const FilterBank* filters) {
        const ImageView view = frame.videoView();
        step_->draw({view, frame.video, ++number_}, matched, frame.work,
                    {.mode = SuperResMode::Detail,
                     .upscaledTiles = false,
                     .plainTiles = false,
                     .filters = filters});
        return step_->output().host();
    }
    static CellWeights weightsOf(const DetailCase& frame) {
        CellWeights out;
        out.weighed.writtenOnHost(rowsOf(frame.weighed, frame.cells));
        out.lookUps.writtenOnHost(rowsOf(frame.lookUps, frame.cells));
        out.trust.writtenOnHost(rowsOf(frame.trust, frame.cells));
        return out;
    }
    template <class T>
    static Rows<const T> rowsOf(const std::vector<T>& cells, Size size) {
        return {cells.data(), size.width, size};
    }
    [[nodiscard]] std::unique_ptr<Engine> engineOf(EngineKind kind) const {
        return kind == EngineKind::Gles ? makeGlesEngine(setup_) : makeSimdEngine(setup_);
    }

    StepSetup setup_;
    std::unique_ptr<Engine> stillEngine_, detailEngine_;
    std::unique_ptr<StillStep> still_, secondStill_;
    std::unique_ptr<DetailStep> step_;
    const StillPictures& pictures_;
    std::uint64_t number_ = 0;
};

std::vector<std::uint32_t> copyOf(Rows<const std::uint32_t> picture) {
    std::vector<std::uint32_t> out;
    for (int y = 0; y < picture.size.height; ++y)
        out.insert(out.end(), picture[y], picture[y] + picture.size.width);
    return out;
}

double channel(Rows<const std::uint32_t> picture, int x, int y, int c) {
    return static_cast<double>(picture[y][x] >> (8 * c) & 255U);
}

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
        // Tolerance: shaders read the still with weights of 8 bits, at positions in half precision.
        expectPicture(
            drawing.draw(frame, options.learned),
            [&](int x, int y, int c) { return wanted.withStill(x, y, c, still); },
            kLearnedError + (shaders ? 1.2 : 0));
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
            kLearnedError + (shaders ? 1.2 : 0));
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

// The still's position (look-up) of every cell changes, but only some tiles are drawn. The drawn
// tiles must equal those of a whole frame, although their detail depends on neighbouring tiles too.
void expectOnlyChangedTiles(const StepEngines& engines, const simd::Sizes& sizes,
                            const FilterBank* filters) {
    const auto& [video, stillSize, output] = sizes;
    const DetailCase before = withRoom(DetailCase(video, stillSize));
    DetailCase part = withRoom(DetailCase(video, stillSize, 0.4));
    for (LookUpCell& cell : part.lookUps) {
        cell.x += 3.5F;
        cell.y -= 2.25F;
    }
    DetailCase whole = part;
    whole.work = before.work;
    Drawing drawing(engines, before, output), other(engines, before, output);
    drawing.draw(before, filters);
    const Rows<const std::uint32_t> some = drawing.draw(part, filters),
                                    all = other.draw(whole, filters);
    Drawing third(engines, before, output);
    const Rows<const std::uint32_t> old = third.draw(before, filters);
    int most = 0;
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x) {
            const bool changed = part.work
                                     .at(simd::tileAt(x, video.width, output.width),
                                         simd::tileAt(y, video.height, output.height))
                                     .changed != 0;
            ASSERT_EQ(some[y][x], changed ? all[y][x] : old[y][x])
                << output.width << ": " << x << " " << y;
            most = std::max(most, std::abs(static_cast<int>(channel(all, x, y, 1)) -
                                           static_cast<int>(channel(old, x, y, 1))));
        }
    EXPECT_TRUE(most > 5 || output == video)
        << "the test needs a still that changes the picture; change: " << most;
}

TEST_P(DetailEngineTest, OnlyChangedTilesAreDrawnAndMatchAWholeFrame) {
    for (const simd::Sizes& sizes : simd::kSizes)
        expectOnlyChangedTiles(GetParam(), sizes, nullptr);
}

TEST_P(DetailEngineTest, OnlyChangedTilesAreEnlargedByFilters) {
    for (const simd::Sizes& sizes : simd::kSizes)
        expectOnlyChangedTiles(GetParam(), sizes, &FilterBank::prior());
}

TEST_P(DetailEngineTest, OnlyChangedTilesGetGuidance) {
    for (const simd::Sizes& sizes : simd::kSizes)
        expectOnlyChangedTiles(GetParam(), sizes, &simd::guidedBank());
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

/// `most`: limit of the difference of any channel. `rms`: limit of its root mean square.
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

// Detail is the still minus its mean over each video pixel. The kernels compute this mean from the
// warped still of the output's size, the shaders from the still itself. The two means are equal
// only if the output is finer than the video; smaller outputs are left out.
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
    expectTheSamePicture(nullptr, 4, 0.85);
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
