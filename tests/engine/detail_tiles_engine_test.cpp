#include "tests/engine/detail_drawing.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace mfar {
namespace {

class DetailTilesTest : public DetailEngineTest {};
INSTANTIATE_TEST_SUITE_P(Engines, DetailTilesTest, DetailTilesTest::everyPair(),
                         DetailTilesTest::nameOfPair);

// A pixel belongs to the tile that contains its centre. At this size, edges of tiles cross output
// pixels on both sides of the pixels' centres.
TEST_P(DetailTilesTest, DetailEndsExactlyAtTheEdgeOfTheGivenTiles) {
    const Size video{62, 53}, output{223, 190};
    DetailCase frame = withRoom(DetailCase(video, {200, 171}));
    const PixelRect some{1, 2, 2, 4};
    std::array<std::vector<std::uint32_t>, 3> drawn;
    const std::array<PixelRect, 3> rectangles{frame.work.detailTiles, PixelRect{}, some};
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        frame.work.detailTiles = rectangles[i];
        drawn[i] = copyOf(Drawing(GetParam(), frame, output).draw(frame));
    }
    for (int y = 0; y < output.height; ++y)
        for (int x = 0; x < output.width; ++x) {
            const int column = simd::tileAt(x, video.width, output.width);
            const int row = simd::tileAt(y, video.height, output.height);
            const bool inside =
                column >= some.x0 && column < some.x1 && row >= some.y0 && row < some.y1;
            const std::size_t i = static_cast<std::size_t>(y) * output.width + x;
            ASSERT_EQ(drawn[2][i], drawn[inside ? 0 : 1][i]) << x << " " << y;
        }
    EXPECT_NE(drawn[0], drawn[1]);
}

// The look-up (position in the still) of every cell changes, but only some tiles are drawn. The
// drawn tiles must equal those of a whole frame, although their detail depends on neighbouring
// tiles too.
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
        << "the changed look-ups must change the picture; largest change: " << most;
}

TEST_P(DetailTilesTest, OnlyChangedTilesAreDrawnAndMatchAWholeFrame) {
    for (const simd::Sizes& sizes : simd::kSizes)
        expectOnlyChangedTiles(GetParam(), sizes, nullptr);
}

TEST_P(DetailTilesTest, OnlyChangedTilesAreEnlargedByFilters) {
    for (const simd::Sizes& sizes : simd::kSizes)
        expectOnlyChangedTiles(GetParam(), sizes, &FilterBank::prior());
}

TEST_P(DetailTilesTest, OnlyChangedTilesGetGuidance) {
    for (const simd::Sizes& sizes : simd::kSizes)
        expectOnlyChangedTiles(GetParam(), sizes, &simd::guidedBank());
}

}  // namespace
}  // namespace mfar
