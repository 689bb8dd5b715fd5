#include "tests/engine/simd/detail_oracle.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar::simd {
namespace {

TEST(DetailStep, WholeFrameMatchesTheOracleAtAnySize) {
    for (const auto& [video, stillSize, output] : kSizes) {
        const DetailCase frame(video, stillSize);
        const Drawn drawn(frame, output, {SuperResMode::Detail, true, false, true});
        Wanted wanted(frame, output, kDetail, true);
        const Grey still = lumaPlane(drawn.still);
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x) {
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(drawn.channel(x, y, c), wanted.withStill(x, y, c, still), 0.8)
                        << output.width << ": " << x << " " << y << " " << c;
                ASSERT_EQ(drawn.channel(x, y, 3), 255);
            }
    }
}

TEST(DetailStep, WithoutAStillTheVideoIsEnlargedCubicallyOrLinearly) {
    for (const auto& [video, stillSize, output] : kSizes)
        for (const bool cubic : {true, false}) {
            const DetailCase frame(video, stillSize);
            const DetailOptions options{SuperResMode::Off, cubic, true, true};
            const Drawn drawn(frame, output, options, false);
            const Wanted wanted(frame, output, options, false);
            for (int y = 0; y < output.height; ++y)
                for (int x = 0; x < output.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(drawn.channel(x, y, c), wanted.enlarged(x, y, c), 0.65)
                            << output.width << ": " << x << " " << y;
            EXPECT_EQ(drawn.summary.tiles[1], frame.work.tiles.width * frame.work.tiles.height);
            EXPECT_EQ(drawn.summary.unexplained, drawn.summary.tiles[1]);
            EXPECT_EQ(drawn.summary.confidence, 0);
        }
}

TEST(DetailStep, ModeBlendMixesVideoAndStillByConfidence) {
    for (const auto& [video, stillSize, output] : kSizes) {
        const DetailCase frame(video, stillSize);
        const DetailOptions options{SuperResMode::Blend, true, true, true};
        Drawn drawn(frame, output, options);
        const Wanted wanted(frame, output, options, true);
        const Rows<const std::uint32_t> picture = drawn.still.picture();
        for (int c = 0; c < 3; ++c) {
            const Grey channel = twin::greyOf(
                picture.size, [&](int x, int y) { return double(picture[y][x] >> (8 * c) & 255); });
            for (int y = 0; y < output.height; ++y)
                for (int x = 0; x < output.width; ++x)
                    ASSERT_NEAR(drawn.channel(x, y, c), wanted.blended(x, y, c, channel), 1.1)
                        << output.width << ": " << x << " " << y;
        }
    }
}

TEST(DetailStep, OnlyChangedTilesAreDrawnAndMatchAWholeFrame) {
    for (const auto& [video, stillSize, output] : kSizes) {
        const DetailCase part(video, stillSize, 0.4), whole(video, stillSize);
        for (const auto& [mode, bank] :
             {std::pair{SuperResMode::Detail, static_cast<const FilterBank*>(nullptr)},
              {SuperResMode::Detail, &FilterBank::prior()},
              {SuperResMode::Blend, nullptr}}) {
            const DetailOptions options{mode, true, false, true, bank};
            const Drawn some(part, output, options), all(whole, output, options);
            for (int y = 0; y < output.height; ++y)
                for (int x = 0; x < output.width; ++x) {
                    const bool changed = part.work
                                             .at(tileAt(x, video.width, output.width),
                                                 tileAt(y, video.height, output.height))
                                             .changed != 0;
                    ASSERT_EQ(some.out[y][x], changed ? all.out[y][x] : kBefore)
                        << output.width << ": " << x << " " << y;
                }
        }
    }
}

TEST(DetailStep, UnchangedFramesDrawNothing) {
    DetailCase frame({64, 48}, {200, 150}, 0.4);
    for (TileWork::Tile& tile : frame.work.flags)
        tile.changed = 0;
    frame.work.changed = 0;
    const Drawn drawn(frame, {200, 150}, kDetail);
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 200; ++x)
            ASSERT_EQ(drawn.out[y][x], kBefore);
    EXPECT_EQ(drawn.summary.tiles[0], 12);
}

void expectDetailIn(const DetailCase& frame, const Drawn& drawn, Size output,
                    const std::function<bool(int, int)>& inTile) {
    Wanted wanted(frame, output, kDetail, true);
    const Grey still = lumaPlane(drawn.still);
    const Size video = frame.rig.video.size;
    double most = 0;
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x) {
            const double with = wanted.withStill(x, y, 1, still),
                         without = wanted.enlarged(x, y, 1);
            const bool in = inTile(tileAt(x, video.width, output.width),
                                   tileAt(y, video.height, output.height));
            ASSERT_NEAR(drawn.channel(x, y, 1), in ? with : without, 0.8) << x << " " << y;
            if (!in) most = std::max(most, std::abs(with - without));
        }
    EXPECT_GT(most, 5) << "the test needs detail that would be visible in other tiles";
}

TEST(DetailStep, DetailIsOnlyAddedInTheGivenRectangleOfTiles) {
    const Size output{576, 432};
    DetailCase frame({160, 120}, {400, 300});
    frame.work.detailTiles = {2, 1, 7, 6};
    const Drawn drawn(frame, output, {SuperResMode::Detail, true, false, true});
    expectDetailIn(frame, drawn, output, [](int column, int row) {
        return column >= 2 && column < 7 && row >= 1 && row < 6;
    });
}

TEST(DetailStep, IfTheWholeFrameIsEnlargedOnlyMatchedTilesHaveDetail) {
    const Size output{576, 432};
    DetailCase frame({160, 120}, {400, 300});
    frame.work.draw = TileWork::Draw::WholeEnlarged;
    for (std::size_t i = 0; i < frame.work.flags.size(); ++i)
        frame.work.flags[i].matched = i % 3 == 0;
    const Drawn drawn(frame, output, {SuperResMode::Detail, true, false, true});
    expectDetailIn(frame, drawn, output, [&](int column, int row) {
        return (row * frame.work.tiles.width + column) % 3 == 0;
    });
}

TEST(DetailStep, ConstantPictureStaysConstant) {
    DetailCase frame({53, 37}, {200, 140});
    for (const int level : {0, 1, 100, 254, 255}) {
        std::ranges::fill(frame.videoPixels, static_cast<std::uint8_t>(level));
        std::ranges::fill(frame.stillPixels, static_cast<std::uint8_t>(level));
        frame.video.take(frame.videoView());
        for (const FilterBank* bank :
             {static_cast<const FilterBank*>(nullptr), &evenBank(), &FilterBank::prior()}) {
            const Drawn drawn(frame, {191, 133}, {SuperResMode::Detail, true, true, true, bank});
            for (int y = 0; y < 133; ++y)
                for (int x = 0; x < 191; ++x)
                    ASSERT_EQ(drawn.out[y][x], 0xff000000U | 0x10101U * level) << x << " " << y;
        }
    }
}

TEST(DetailStep, InvalidLookUpsAreIgnored) {
    const Size output{191, 133};
    DetailCase valid({53, 37}, {200, 140}), broken = valid;
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                    kInfinite = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < broken.lookUps.size(); ++i) {
        const float bad = i % 3 == 0 ? kNan : i % 3 == 1 ? kInfinite : -kInfinite;
        broken.lookUps[i] = {bad, bad, bad, bad};
        broken.trust[i] = {bad, bad, bad, bad};
        broken.weighed[i] = {bad, bad, bad, bad};
        valid.lookUps[i] = {};
        valid.trust[i] = {};
        valid.weighed[i] = {};
    }
    for (const SuperResMode mode : {SuperResMode::Detail, SuperResMode::Blend}) {
        const DetailOptions options{mode, true, false, true};
        const Drawn a(valid, output, options), b(broken, output, options);
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x)
                ASSERT_EQ(a.out[y][x], b.out[y][x]);
        EXPECT_EQ(b.summary.confidence, 0);
    }
}

TEST(DetailStep, LookUpsBeyondTheStillShowItsBorder) {
    const Size output{191, 133};
    DetailCase frame({53, 37}, {200, 140});
    for (LookUpCell& cell : frame.lookUps) {
        cell.x = -4000;
        cell.y = 4000;
    }
    const Drawn drawn(frame, output, {SuperResMode::Detail, true, false, true});
    Wanted wanted(frame, output, kDetail, true);
    const Grey still = lumaPlane(drawn.still);
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x)
            ASSERT_NEAR(drawn.channel(x, y, 0), wanted.withStill(x, y, 0, still), 0.8);
}

TEST(DetailStep, TilesWithoutWeightAreOnlyEnlarged) {
    DetailCase frame({160, 120}, {400, 300});
    const Drawn skipping(frame, {576, 432}, kDetail),
        drawing(frame, {576, 432}, {SuperResMode::Detail, true, false, true});
    EXPECT_GT(skipping.summary.tiles[1], 0);
    EXPECT_EQ(drawing.summary.tiles[1], 0);
    int worst = 0;
    for (int y = 0; y < 432; ++y)
        for (int x = 0; x < 576; ++x)
            worst = std::max(worst, std::abs(skipping.channel(x, y, 0) - drawing.channel(x, y, 0)));
    EXPECT_LE(worst, 2);
}

TEST(DetailStep, UnmatchedTilesStayCountedUntilTheyAreDrawnAgain) {
    DetailCase frame({64, 48}, {200, 150});
    const auto workers = std::make_shared<Workers>(2);
    StillPreparation still(frame.rig, {200, 150}, workers);
    still.set(frame.stillView());
    DetailStep step(still.rig(), {200, 150}, workers);
    AlignedRows<std::uint32_t> out({200, 150});
    for (TrustCell& cell : frame.trust)
        cell.unexplained = 1;
    const TileSummary first = step.draw(frame.input(&still), kDetail, out.rows());
    EXPECT_EQ(first.unexplained, 12);
    for (TrustCell& cell : frame.trust)
        cell.unexplained = 0;
    frame.work.draw = TileWork::Draw::Tiles;
    for (std::size_t i = 0; i < frame.work.flags.size(); ++i)
        frame.work.flags[i].changed = i < 5 ? 1 : 0;
    frame.work.changed = 5;
    const TileSummary second = step.draw(frame.input(&still), kDetail, out.rows());
    EXPECT_EQ(second.unexplained, 7);
    EXPECT_EQ(second.tiles[0], 7);
    EXPECT_EQ(second.confidence, first.confidence);
}

}  // namespace
}  // namespace mfar::simd
