#include "pipeline/simd/census_rows.h"
#include "pipeline/simd/label_lines.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace mfar::simd {
namespace {

using test::Ray;

constexpr Size kCanvas{90, 70};

struct Problem {
    LabelLines lines{test::barrel(), 0.8F, 0.3F, -0.2F, 8, 8, 0.012F};
    std::vector<float> raysX, raysY;
    std::vector<std::int16_t> base;
    std::vector<std::uint32_t> own, still;

    explicit Problem(std::size_t width, unsigned seed)
        : raysX(test::randomValues<float>(width, -0.6, 0.6, seed)),
          raysY(test::randomValues<float>(width, -0.5, 0.5, seed + 1)),
          base(test::randomValues<std::int16_t>(width, -20, 20, seed + 2)),
          own(test::randomValues<std::uint32_t>(width, 0, 1 << kCensusBits, seed + 3)),
          still(test::randomValues<std::uint32_t>(90UL * 70, 0, 1 << kCensusBits, seed + 4)) {
        for (std::size_t i = 0; i < still.size(); i += 7)
            still[i] = kNoCensus;
    }
    [[nodiscard]] LabelRow row() const { return {raysX.data(), raysY.data(), raysX.size()}; }
    [[nodiscard]] Ray pointOf(std::size_t x, double label) const {
        const double s = lines.perLabel * label;
        const Ray p = test::project(lines.lens, raysX[x] + s * (lines.tx - raysX[x] * lines.tz),
                                    raysY[x] + s * (lines.ty - raysY[x] * lines.tz));
        return {p.x - lines.originX, p.y - lines.originY};
    }
    [[nodiscard]] int costAt(Ray p, std::uint32_t census) const {
        const auto u = std::floor(p.x + 0.5), v = std::floor(p.y + 0.5);
        if (!(u >= 0 && v >= 0 && u < kCanvas.width && v < kCanvas.height)) return kCensusBits / 2;
        const std::uint32_t seen =
            still[static_cast<std::size_t>(v) * kCanvas.width + static_cast<std::size_t>(u)];
        return seen == kNoCensus ? kCensusBits / 2 : std::popcount(census ^ seen);
    }
    [[nodiscard]] std::vector<std::uint8_t> costs(int vectors, bool slack) const {
        std::vector<std::uint8_t> out(own.size() * vectors * kLabels);
        labelCosts(lines, row(), base.data(), own.data(), {still.data(), kCanvas}, vectors, slack,
                   out.data());
        return out;
    }
};

// A label is an inverse depth in steps of LabelLines::perLabel. Labels are processed in vectors of
// 16, whose points lie evenly on a straight line in the still. Here, a label's cost is the Hamming
// distance of the pixel's census from that of the still pixel nearest to the label's point. With
// `slack`, it is the least of three distances: from this still pixel, and from the still pixels
// nearest to the points one pixel to the left and to the right of the line.
TEST(LabelCosts, CostOfALabelIsItsCensusDistanceToTheNearestStillPixel) {
    for (const std::size_t width : {1UL, 5UL, 64UL, 150UL}) {
        for (const int vectors : {1, 3}) {
            for (const bool slack : {false, true}) {
                const Problem p(width, 10);
                const auto costs = p.costs(vectors, slack);
                std::size_t compared = 0, differing = 0;
                for (std::size_t n = 0; n < costs.size(); ++n) {
                    const std::size_t x = n / (kLabels * vectors);
                    const std::size_t label = n % (kLabels * vectors), first = label / 16 * 16;
                    const double low = p.base[x] + static_cast<double>(first);
                    const Ray from = p.pointOf(x, low), to = p.pointOf(x, low + 15);
                    const double a = static_cast<double>(label - first) / 15;
                    const double wayX = to.x - from.x, wayY = to.y - from.y;
                    const double way = std::hypot(wayX, wayY);
                    int expected = 1000;
                    bool between = false;
                    for (const int side : {0, -1, 1}) {
                        if (side != 0 && !slack) continue;
                        const Ray at{from.x + a * wayX - side * wayY / way,
                                     from.y + a * wayY + side * wayX / way};
                        between = between || test::isBetween(at.x) || test::isBetween(at.y);
                        expected = std::min(expected, p.costAt(at, p.own[x]));
                    }
                    if (between) continue;
                    ++compared;
                    if (costs[n] != expected) ++differing;
                }
                EXPECT_EQ(differing, 0U) << "number of wrong costs among " << compared;
                EXPECT_GT(compared, costs.size() / 2);
            }
        }
    }
}

double placeOf(const Problem& p, std::size_t x, const Valley& valley) {
    const Ray here = p.pointOf(x, valley.label), next = p.pointOf(x, valley.label + 1);
    const double wayX = next.x - here.x, wayY = next.y - here.y, square = wayX * wayX + wayY * wayY;
    struct Foot {
        double x, y, label;
    };
    const auto footOf = [&](int k) {
        const double u = std::floor(here.x + k * wayX + 0.5),
                     v = std::floor(here.y + k * wayY + 0.5);
        return Foot{u, v, ((u - here.x) * wayX + (v - here.y) * wayY) / square};
    };
    const Foot own = footOf(0);
    double foot[2] = {0, 0};
    int rise[2] = {Valley::kUnknown, Valley::kUnknown};
    for (const int side : {0, 1})
        for (const int far : {2, 1}) {
            const int k = side == 0 ? -far : far;
            const Foot other = footOf(k);
            if (other.x == own.x && other.y == own.y) continue;
            foot[side] = other.label;
            rise[side] = valley.rise[k < 0 ? k + 2 : k + 1];
        }
    if (rise[0] == Valley::kUnknown || rise[1] == Valley::kUnknown) return own.label;
    // The minimum is where a falling and a rising line meet. Both are as steep as the steeper of
    // the two sides.
    const double left = rise[0] / (own.label - foot[0]), right = rise[1] / (foot[1] - own.label);
    if (!(std::max(left, right) > 0)) return own.label;
    return right > left ? 0.5 * (foot[0] + own.label + rise[0] / right)
                        : 0.5 * (foot[1] + own.label - rise[1] / left);
}

bool isNearBorder(const Problem& p, std::size_t x, int label) {
    const Ray here = p.pointOf(x, label), next = p.pointOf(x, label + 1);
    for (int k = -2; k <= 2; ++k)
        if (test::isBetween(here.x + k * (next.x - here.x)) ||
            test::isBetween(here.y + k * (next.y - here.y)))
            return true;
    return false;
}

TEST(LabelPlaces, PositionsBetweenLabelsMatchTheOracle) {
    for (const std::size_t width : {1UL, 16UL, 37UL, 200UL}) {
        const Problem p(width, 20);
        const auto rises = test::randomValues<std::uint8_t>(4 * width, 0, 60, 9);
        std::vector<Valley> valleys(width);
        for (std::size_t x = 0; x < width; ++x) {
            valleys[x].label = p.base[x];
            std::copy_n(rises.begin() + static_cast<std::ptrdiff_t>(4 * x), 4,
                        valleys[x].rise.begin());
            if (x % 9 == 0) valleys[x].rise[x % 4] = Valley::kUnknown;
            if (x % 11 == 0) valleys[x].rise = {};
        }
        std::vector<float> places(width);
        labelPlaces(p.lines, p.row(), valleys.data(), places.data());
        for (std::size_t x = 0; x < width; ++x) {
            if (isNearBorder(p, x, valleys[x].label)) continue;
            ASSERT_NEAR(places[x] - static_cast<float>(valleys[x].label), placeOf(p, x, valleys[x]),
                        2e-3)
                << x;
        }
    }
}

TEST(LabelVertices, TheFractionOfALabelIsWhereTwoCostLinesMeet) {
    for (const std::size_t count : test::kLengths) {
        std::vector<Valley> valleys(count);
        for (std::size_t i = 0; i < count; ++i)
            valleys[i] = {
                static_cast<int>(i) - 5,
                {0, static_cast<std::uint8_t>(i % 5 * 4), static_cast<std::uint8_t>(8), 0}};
        valleys[count / 2].rise = {0, 0, 0, 0};
        valleys[count - 1].rise = {0, Valley::kUnknown, 3, 0};
        std::vector<float> found(count);
        labelVertices(valleys.data(), count, found.data());
        for (std::size_t i = 0; i < count; ++i) {
            const auto& v = valleys[i];
            const int rise = std::max(v.rise[1], v.rise[2]);
            const bool plain = rise == 0 || rise == Valley::kUnknown;
            EXPECT_FLOAT_EQ(found[i],
                            static_cast<float>(v.label) +
                                (plain ? 0
                                       : 0.5F * static_cast<float>(v.rise[1] - v.rise[2]) /
                                             static_cast<float>(rise)));
        }
    }
}

}  // namespace
}  // namespace mfar::simd
