#include "pipeline/plan/tile_measure.h"
#include "pipeline/plan/tiles.h"
#include "tests/engine/simd/every_target.h"
#include "tests/oracle/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <tuple>

namespace mfar {
namespace {

TestPicture tilePicture(Size size, unsigned seed, double sigma) {
    TestPicture out(size, PixelFormat::Rgba8, 255);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, sigma);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double edge = x % 37 < 9 ? 30 : 0;
                const double level = 100 + 60 * std::sin(0.05 * x + c) * std::cos(0.03 * y) + edge;
                out.at(x, y)[c] = static_cast<std::uint8_t>(
                    std::clamp(std::round(level + noise(random)), 0.0, 255.0));
            }
    return out;
}

RgbPlanes planesFrom(const TestPicture& picture) {
    RgbPlanes out(picture.size);
    out.take(picture.view());
    return out;
}

constexpr ChangeBounds kTileBounds{3, 5.5, 1.2F};

std::vector<TileMeasure> measured(const TestPicture& now, const TestPicture& drawn,
                                  Workers* workers = nullptr) {
    std::vector<TileMeasure> out;
    measureTiles(planesFrom(now), planesFrom(drawn), kTileBounds, workers, out);
    return out;
}

bool same(const std::vector<TileMeasure>& a, const std::vector<TileMeasure>& b) {
    const auto bits = [](const TileMeasure& t) {
        std::array<std::uint32_t, 5> out{};
        const float values[]{t.noise, t.structure, t.pixels, t.means, t.bends};
        std::memcpy(out.data(), values, sizeof values);
        return std::tuple(t.changed, t.changedCells, out);
    };
    return std::ranges::equal(a, b, {}, bits, bits);
}

class TileRows : public testing::TestWithParam<Size> {};

TEST_P(TileRows, MeasuresOfEveryTileMatchTheOracle) {
    const Size size = GetParam();
    for (const double sigma : {0.0, 1.0, 3.0}) {
        const TestPicture now = tilePicture(size, 1, sigma), drawn = tilePicture(size, 2, sigma);
        const twin::Grey grey = twin::luma(now.view());
        const auto got = measured(now, drawn);
        const int columns = tilesOf(size).width;
        ASSERT_EQ(got.size(), std::size_t{1} * columns * tilesOf(size).height);
        const twin::ChangeBounds bounds{kTileBounds.mean, kTileBounds.absolute};
        for (int i = 0; i < static_cast<int>(got.size()); ++i) {
            SCOPED_TRACE(testing::Message() << "tile " << i << ", noise " << sigma);
            const twin::TileChange t = twin::tileChange(now, drawn, grey, i % columns, i / columns,
                                                        double{kTileBounds.grain});
            const TileMeasure& m = got[static_cast<std::size_t>(i)];
            EXPECT_NEAR(m.noise, t.noise, 0.005);
            EXPECT_NEAR(m.structure, t.structure, 1e-3 * (1 + t.structure));
            EXPECT_NEAR(m.pixels, t.energy[0], 1e-3 * (1 + t.energy[0]));
            EXPECT_NEAR(m.means, t.energy[1], 1e-3 * (1 + t.energy[1]));
            EXPECT_NEAR(m.bends, t.energy[2], 1e-3 * (1 + t.energy[2]));
            if (bounds.isClose(t)) continue;
            EXPECT_EQ(m.changed, bounds.surely(t));
            for (int cell = 0; cell < 16; ++cell)
                EXPECT_EQ((m.changedCells >> cell & 1) != 0, bounds.surely(t, cell)) << cell;
        }
    }
}

TEST_P(TileRows, ResultsAreIdenticalForAllInstructionSetsAndThreads) {
    const TestPicture now = tilePicture(GetParam(), 1, 1.3),
                      drawn = tilePicture(GetParam(), 2, 1.3);
    const auto wanted = measured(now, drawn);
    test::onEveryTarget([&] { EXPECT_TRUE(same(measured(now, drawn), wanted)); });
    Workers workers(3);
    EXPECT_TRUE(same(measured(now, drawn, &workers), wanted));
}

INSTANTIATE_TEST_SUITE_P(Sizes, TileRows,
                         testing::Values(Size{1, 1}, Size{16, 16}, Size{17, 33}, Size{317, 67},
                                         Size{640, 48}, Size{288, 16}));

}  // namespace
}  // namespace mfar
