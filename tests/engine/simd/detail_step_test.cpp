#include "pipeline/simd/detail_step.h"
#include "tests/engine/simd/detail_case.h"
#include "tests/oracle/still.h"

#include <gtest/gtest.h>

#include <limits>

namespace mfar::simd {
namespace {

using twin::Grey;

constexpr std::uint32_t kBefore = 0x12345678;  // what the output held
constexpr DetailOptions kDetail{SuperResMode::Detail, true, true, true};

/// A frame drawn over kBefore.
struct Drawn {
    Drawn(const DetailCase& frame, Size output, const DetailOptions& options, bool usesStill = true,
          int threads = 2)
        : still(frame.rig, output, std::make_shared<Workers>(threads)),
          step(still.rig(), output, std::make_shared<Workers>(threads)), out(output) {
        still.set(frame.stillView());
        for (int y = 0; y < output.height; ++y)
            std::fill_n(out[y], output.width, kBefore);
        summary = step.draw(frame.input(usesStill ? &still : nullptr), options, out.rows());
    }
    [[nodiscard]] int channel(int x, int y, int c) const {
        return static_cast<int>(out[y][x] >> (8 * c) & 255);
    }

    StillPreparation still;
    DetailStep step;
    AlignedRows<std::uint32_t> out;
    TileSummary summary;
};

/// What a frame is to look like.
class Wanted {
public:
    Wanted(const DetailCase& frame, Size output, const DetailOptions& options, bool usesStill)
        : frame_(frame), output_(output), options_(options), usesStill_(usesStill) {
        const bool linear = !options.cubic && options.mode == SuperResMode::Off;
        for (int c = 0; c < 3; ++c) {
            Grey plane = twin::greyOf(frame.rig.video.size, [&](int x, int y) {
                return double(frame.video.row(c, y)[x]);
            });
            if (usesStill && options.mode == SuperResMode::Detail) {
                plane = twin::sharpened(plane, [&](int x, int y) { return strength(x, y); });
                for (double& value : plane.values)
                    value = std::clamp(value, 0.0, 255.0);
            }
            video_[c] = twin::enlarged(plane, output, linear);
        }
        const auto field = [&](auto member) {
            return twin::greyOf(frame.cells, [&](int x, int y) {
                return double(frame.lookUps[y * frame.cells.width + x].*member);
            });
        };
        lookUp_ = {field(&LookUpCell::x), field(&LookUpCell::y), field(&LookUpCell::weight),
                   field(&LookUpCell::confidence)};
    }

    [[nodiscard]] double enlarged(int x, int y, int c) const {
        return std::clamp(video_[c].at(x, y), 0.0, 255.0);
    }
    /// `stillAt`: detail, or a channel of the still, at (x, y) of it.
    [[nodiscard]] double withStill(int x, int y, int c, const Grey& still) const {
        const Size video = frame_.rig.video.size;
        const double vx = (x + 0.5) * video.width / output_.width,
                     vy = (y + 0.5) * video.height / output_.height;
        const auto at = [&](int i) { return lookUp_[i].bilinear(vx / 4 - 0.5, vy / 4 - 0.5); };
        const double scale = double(still.size.width) / video.width,
                     scaleY = double(still.size.height) / video.height;
        const double px = vx * scale + at(0) - 0.5, py = vy * scaleY + at(1) - 0.5;
        const double there = still.bilinear(std::clamp(px, -1.0, double(still.size.width)),
                                            std::clamp(py, -1.0, double(still.size.height)));
        const double up = video_[c].at(x, y);
        return std::clamp(options_.mode == SuperResMode::Blend
                              ? std::lerp(std::clamp(up, 0.0, 255.0), there, at(3))
                              : up + at(2) * (there - 128),
                          0.0, 255.0);
    }

private:
    [[nodiscard]] double strength(int x, int y) const {
        const auto field = [&](auto member) {
            return twin::greyOf({2, 2}, [&](int i, int j) {
                const int cx = std::clamp((x - 2 + 4 * i) >> 2, 0, frame_.cells.width - 1),
                          cy = std::clamp((y - 2 + 4 * j) >> 2, 0, frame_.cells.height - 1);
                return double(frame_.trust[cy * frame_.cells.width + cx].*member);
            });
        };
        const double fx = ((x - 2) & 3) / 4.0 + 0.125, fy = ((y - 2) & 3) / 4.0 + 0.125;
        return (1 - std::min(2 * field(&TrustCell::halfWeight).bilinear(fx, fy), 1.0)) *
               field(&TrustCell::signal).bilinear(fx, fy);
    }

    const DetailCase& frame_;
    Size output_;
    DetailOptions options_;
    bool usesStill_;
    std::array<Grey, 3> video_;
    std::array<Grey, 4> lookUp_;
};

Grey detailPlane(const StillPreparation& still) {
    const Rows<const std::uint8_t> rows = still.detail();
    return twin::greyOf(rows.size, [&](int x, int y) { return double(rows[y][x]); });
}

struct Sizes {
    Size video, still, output;
};
const std::vector<Sizes> kSizes{
    {{160, 120}, {400, 300}, {576, 432}}, {{53, 37}, {200, 140}, {191, 133}},
    {{16, 16}, {70, 65}, {57, 58}},       {{64, 48}, {200, 150}, {64, 48}},
    {{100, 60}, {90, 54}, {61, 37}},      {{35, 18}, {64, 33}, {1300, 700}}};

TEST(DetailStep, WholeFrameIsTheOraclesAtAnySize) {
    for (const auto& [video, still, output] : kSizes) {
        const DetailCase frame(video, still);
        const Drawn drawn(frame, output, {SuperResMode::Detail, true, false, true});
        const Wanted wanted(frame, output, kDetail, true);
        const Grey detail = detailPlane(drawn.still);
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x) {
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(drawn.channel(x, y, c), wanted.withStill(x, y, c, detail), 0.8)
                        << output.width << ": " << x << " " << y << " " << c;
                ASSERT_EQ(drawn.channel(x, y, 3), 255);
            }
    }
}

TEST(DetailStep, WithoutAStillTheVideoIsEnlargedCubiclyOrLinearly) {
    for (const auto& [video, still, output] : kSizes)
        for (const bool cubic : {true, false}) {
            const DetailCase frame(video, still);
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

TEST(DetailStep, BlendMixesTheStillByItsConfidence) {
    for (const auto& [video, still, output] : kSizes) {
        const DetailCase frame(video, still);
        const DetailOptions options{SuperResMode::Blend, true, true, true};
        Drawn drawn(frame, output, options);
        const Wanted wanted(frame, output, options, true);
        const Rows<const std::uint32_t> picture = drawn.still.picture();
        for (int c = 0; c < 3; ++c) {
            const Grey channel = twin::greyOf(
                picture.size, [&](int x, int y) { return double(picture[y][x] >> (8 * c) & 255); });
            for (int y = 0; y < output.height; ++y)
                for (int x = 0; x < output.width; ++x)
                    ASSERT_NEAR(drawn.channel(x, y, c), wanted.withStill(x, y, c, channel), 1.1)
                        << output.width << ": " << x << " " << y;
        }
    }
}

/// Tile of an output pixel.
int tileAt(int pixel, int video, int output) {
    return static_cast<int>((pixel + 0.5) * video / output) / kTileSize;
}

TEST(DetailStep, OnlyChangedTilesAreDrawnAndLookAsInAWholeFrame) {
    for (const auto& [video, still, output] : kSizes) {
        const DetailCase part(video, still, 0.4), whole(video, still);
        for (const SuperResMode mode : {SuperResMode::Detail, SuperResMode::Blend}) {
            const DetailOptions options{mode, true, false, true};
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

TEST(DetailStep, NothingChangedDrawsNothing) {
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

/// Expects detail in some tiles, and the sharpened, enlarged video in the others.
void expectDetailIn(const DetailCase& frame, const Drawn& drawn, Size output,
                    const std::function<bool(int, int)>& inTile) {
    const Wanted wanted(frame, output, kDetail, true);
    const Grey detail = detailPlane(drawn.still);
    const Size video = frame.rig.video.size;
    double most = 0;
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x) {
            const double with = wanted.withStill(x, y, 1, detail),
                         without = wanted.enlarged(x, y, 1);
            const bool in = inTile(tileAt(x, video.width, output.width),
                                   tileAt(y, video.height, output.height));
            ASSERT_NEAR(drawn.channel(x, y, 1), in ? with : without, 0.8) << x << " " << y;
            if (!in) most = std::max(most, std::abs(with - without));
        }
    EXPECT_GT(most, 5) << "detail would show in the other tiles";
}

TEST(DetailStep, DetailOfAWholeFrameStaysInItsRectangle) {
    const Size output{576, 432};
    DetailCase frame({160, 120}, {400, 300});
    frame.work.detailTiles = {2, 1, 7, 6};
    const Drawn drawn(frame, output, {SuperResMode::Detail, true, false, true});
    expectDetailIn(frame, drawn, output, [](int column, int row) {
        return column >= 2 && column < 7 && row >= 1 && row < 6;
    });
}

TEST(DetailStep, WholeFrameWithAListHasDetailInMatchedTilesAlone) {
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
        const Drawn drawn(frame, {191, 133}, kDetail);
        for (int y = 0; y < 133; ++y)
            for (int x = 0; x < 191; ++x)
                ASSERT_EQ(drawn.out[y][x], 0xff000000U | 0x10101U * level) << x << " " << y;
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
    const Wanted wanted(frame, output, kDetail, true);
    const Grey detail = detailPlane(drawn.still);
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x)
            ASSERT_NEAR(drawn.channel(x, y, 0), wanted.withStill(x, y, 0, detail), 0.8);
}

TEST(DetailStep, WeightlessTilesAreEnlargedAlone) {
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

TEST(DetailStep, UnexplainedTilesAreRememberedUntilTheyAreDrawn) {
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
