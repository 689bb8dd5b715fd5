#include "pipeline/gles/flow2d.h"
#include "pipeline/gles/tile_lists.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace mfar {
namespace {

using TileListsGl = GlTest;
using Eigen::Vector2d;
using Cell = std::array<float, 4>;

constexpr Size kVideoSize{301, 230};
constexpr Size kCells{76, 58};
constexpr Size kTiles{19, 15};
constexpr int kLevels = 4;
constexpr int kCount = kCells.width * kCells.height;

/// Fields in the format of refine()'s output: flow, cost and texture of each cell, then the two-way
/// errors (lengths of forward plus backward flow).
std::vector<Cell> randomFields(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Cell> out(2UL * kCount);
    for (int i = 0; i < kCount; ++i) {
        const bool bad = unit(random) < 0.16F;
        out[i] = {9 * unit(random), 9 * unit(random), bad ? 0.41F + unit(random) : 0.39F,
                  unit(random) < 0.6F ? 3000.0F : 100.0F};
        out[kCount + i] = {unit(random) < 0.1F ? 1e4F : 20 * unit(random), 0, 0, 0};
    }
    return out;
}

gpu::Buffer stored(const std::vector<Cell>& fields) {
    gpu::Buffer cells(fields.size() * sizeof(Cell));
    cells.write(std::span<const Cell>(fields));
    return cells;
}

std::vector<bool> twinFlags(const std::vector<Cell>& fields) {
    std::vector<int> cells(kTiles.width * kTiles.height);
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const int i = y * kCells.width + x;
            if (fields[i][2] > 0.4F && fields[i][3] > 1000 && fields[kCount + i][0] < 100)
                ++cells[y / 4 * kTiles.width + x / 4];
        }
    std::vector<bool> out;
    for (const int n : cells)
        out.push_back(n >= 3);
    return out;
}

std::vector<bool> twinClosed(const std::vector<bool>& flags) {
    const auto at = [&](int x, int y) {
        const bool within = x >= 0 && y >= 0 && x < kTiles.width && y < kTiles.height;
        return within && flags[y * kTiles.width + x] ? 1 : 0;
    };
    std::vector<bool> out;
    for (int y = 0; y < kTiles.height; ++y)
        for (int x = 0; x < kTiles.width; ++x)
            out.push_back(at(x, y) != 0 ||
                          at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1) >= 2);
    return out;
}

/// A group is a work group (y * 65536 + x) of the flow search. Returns the groups of the next
/// coarser pyramid level whose results `groups` read: those at the same position and their
/// neighbours.
std::set<std::uint32_t> twinAbove(const std::set<std::uint32_t>& groups, Size level) {
    std::set<std::uint32_t> out;
    for (const std::uint32_t g : groups)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int x = static_cast<int>(g & 0xFFFF) / 2 + i;
                const int y = static_cast<int>(g >> 16) / 2 + j;
                if (x < 0 || y < 0 || x >= level.width || y >= level.height) continue;
                out.insert(static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x));
            }
    return out;
}

std::set<std::uint32_t> listed(const TileLists& lists, int level) {
    const auto command = lists.commands().read<std::uint32_t>(4, 16UL * level);
    EXPECT_EQ(command[1], 1U);
    EXPECT_EQ(command[2], 1U);
    const auto groups =
        lists.lists().read<std::uint32_t>(command[0], sizeof(std::uint32_t) * lists.first(level));
    std::set<std::uint32_t> out(groups.begin(), groups.end());
    EXPECT_EQ(out.size(), groups.size()) << "a group is listed twice";
    return out;
}

TEST_F(TileListsGl, TileFlagsAndListsMatchTheOracles) {
    TileBuffer tiles(kVideoSize);
    TileLists lists(kCells, kLevels);
    const auto fields = randomFields(1);
    const gpu::Buffer cells = stored(fields);
    lists.find({cells, 0, kCount}, tiles);

    const auto wanted = twinClosed(twinFlags(fields));
    EXPECT_EQ(lists.read(), wanted);
    const auto count = std::count(wanted.begin(), wanted.end(), true);
    EXPECT_EQ(lists.count(), count);
    EXPECT_GT(count, 20);
    EXPECT_LT(count, 200);
}

TEST_F(TileListsGl, ListsOfCoarserLevelsContainAllGroupsThatFinerLevelsRead) {
    TileBuffer tiles(kVideoSize);
    TileLists lists(kCells, kLevels);
    std::vector<Cell> fields(2UL * kCount, Cell{0, 0, 0, 1e4F});
    for (const int tile : {0, 60, 200})
        for (int i = 0; i < 3; ++i)
            fields[4 * (tile / kTiles.width) * kCells.width + 4 * (tile % kTiles.width) + i][2] = 1;
    const gpu::Buffer cells = stored(fields);
    lists.find({cells, 0, kCount}, tiles);

    auto wanted = listed(lists, 0);
    EXPECT_EQ(wanted.size(), 3U);
    Size level = kTiles;
    for (int l = 1; l < kLevels; ++l) {
        level = {(level.width + 1) / 2, (level.height + 1) / 2};
        wanted = twinAbove(wanted, level);
        const auto found = listed(lists, l);
        EXPECT_TRUE(std::includes(found.begin(), found.end(), wanted.begin(), wanted.end()))
            << "level " << l;
    }
    EXPECT_LT(listed(lists, 1).size(), 40U);
}

TEST_F(TileListsGl, WithoutMatchedTilesNothingIsListed) {
    TileBuffer tiles(kVideoSize);
    TileLists lists(kCells, kLevels);
    const auto fields = randomFields(2);
    const gpu::Buffer cells = stored(fields);
    lists.find({cells, 0, kCount}, tiles);
    const int before = lists.count();
    TileWork atRest = tiles.work();
    atRest.changed = atRest.matched = 0;
    tiles.set(atRest);
    lists.find({cells, 0, kCount}, tiles);
    EXPECT_GT(before, 0);
    EXPECT_EQ(lists.countBefore(), before);
    EXPECT_EQ(lists.count(), 0);
}

struct MovedSquare {
    static constexpr int kFirst = 96, kEnd = 192;  // the square's pixels are kFirst to kEnd - 1
    static constexpr int kBy = 14;

    MovedSquare() {
        const Waves ground(1, 6, 60, 40), object(2, 6, 60, 40);
        now = ground.shoot(kVideoSize, {});
        then = now;
        const TestPicture square = object.shoot(kVideoSize, {});
        for (int y = kFirst; y < kEnd; ++y)
            for (int x = kFirst; x < kEnd; ++x) {
                std::copy_n(TestPicture(square).at(x, y), 4, now.at(x, y));
                std::copy_n(TestPicture(square).at(x, y), 4, then.at(x, y + kBy));
            }
    }
    [[nodiscard]] static bool within(int x, int y, int border) {
        return std::min(x, y) >= kFirst + border && std::max(x, y) < kEnd - border;
    }

    TestPicture now, then;
};

class Refined {
public:
    Refined(const TestPicture& now, const TestPicture& then) : pyramids_(now.size), flow(now.size) {
        pyramids_.buildVideo(uploaded(now));
        pyramids_.buildSecond(uploaded(then));
        const std::vector<Cell> none(kCount);
        flow.refine(pyramids_.luma(), tiles_, none, none);
    }
    [[nodiscard]] std::vector<Cell> vectors() const { return read(flow.forward()); }
    [[nodiscard]] std::vector<Cell> errors() const { return read(flow.backward()); }

private:
    [[nodiscard]] std::vector<Cell> read(const Flow2d::Field& field) const {
        return flow.cells().read<Cell>(kCount, sizeof(Cell) * field.offset);
    }
    TileBuffer tiles_{kVideoSize};
    LumaPyramids pyramids_;

public:
    Flow2d flow;
};

TEST_F(TileListsGl, MovedObjectsAreFoundAndOtherTilesKeepTheirFlow) {
    const MovedSquare s;
    const Refined r(s.now, s.then);
    const auto vectors = r.vectors(), errors = r.errors();
    const auto tiles = r.flow.searched().read();
    for (int y = 0; y < kCells.height; ++y)
        for (int x = 0; x < kCells.width; ++x) {
            const int i = y * kCells.width + x;
            const bool searched = tiles[y / 4 * kTiles.width + x / 4];
            if (MovedSquare::within(4 * x + 2, 4 * y + 2, 16)) {
                EXPECT_TRUE(searched) << x << ", " << y;
                EXPECT_NEAR(vectors[i][0], 0, 0.2) << x << ", " << y;
                EXPECT_NEAR(vectors[i][1], MovedSquare::kBy, 0.2) << x << ", " << y;
                EXPECT_LT(errors[i][0], 0.5) << x << ", " << y;
            } else if (!MovedSquare::within(4 * x + 2, 4 * y + 2, -36)) {
                EXPECT_FALSE(searched) << x << ", " << y;
                EXPECT_NEAR(vectors[i][0], 0, 0.05) << x << ", " << y;
                EXPECT_NEAR(vectors[i][1], 0, 0.05) << x << ", " << y;
                EXPECT_EQ(errors[i][0], 0) << x << ", " << y;
            }
        }
}

TEST_F(TileListsGl, WithoutMotionNothingIsSearched) {
    const TestPicture still = Waves(3, 6, 60, 40).shoot(kVideoSize, {});
    const Refined r(still, still);
    EXPECT_EQ(r.flow.searched().count(), 0);
    EXPECT_EQ(r.flow.searched().read(), std::vector<bool>(kTiles.width * kTiles.height));
}

TEST_F(TileListsGl, WithoutAMatchTwoWayErrorsFollowFromTheMatchingCost) {
    const Refined r(randomPicture(kVideoSize, 1), randomPicture(kVideoSize, 2));
    EXPECT_EQ(r.flow.searched().count(), kTiles.width * kTiles.height);
    const auto vectors = r.vectors(), errors = r.errors();
    int offLine = 0;
    for (int i = 0; i < kCount; ++i) {
        ASSERT_TRUE(std::isfinite(vectors[i][0]) && std::isfinite(vectors[i][1])) << "cell " << i;
        ASSERT_LE(std::hypot(vectors[i][0], vectors[i][1]), 2.0F * kVideoSize.width)
            << "cell " << i;
        if (errors[i][0] == 0) continue;
        ++offLine;
        EXPECT_NEAR(errors[i][0], 5 * (vectors[i][2] - 0.1F), 1e-3) << "cell " << i;
    }
    EXPECT_GT(offLine, 0);
    EXPECT_LT(offLine, kCount / 2) << "fewer than half of the cells may leave their epipolar line";
}

}  // namespace
}  // namespace mfar
