#include "pipeline/epipolar/semi_global.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mfar {
namespace {

struct Problem {
    LumaImage guide;
    int vectors = 1;
    Smoothness smoothness;
    std::vector<std::int16_t> base;
    std::vector<std::uint8_t> costs;

    [[nodiscard]] int labels() const { return SemiGlobal::kLabels * vectors; }
    [[nodiscard]] std::size_t pixel(int x, int y) const {
        return static_cast<std::size_t>(y) * guide.size.width + x;
    }
};

Problem randomProblem(Size size, int vectors, int reach, unsigned seed, int greatest = 24) {
    std::mt19937 random(seed);
    const auto upTo = [&](int n) { return std::uniform_int_distribution<int>(0, n)(random); };
    Problem p{LumaImage(size), vectors, {}, {}, {}};
    p.smoothness = {12 + upTo(12), 60, 0.5 * upTo(12)};
    for (std::uint8_t& v : p.guide.pixels)
        v = static_cast<std::uint8_t>(upTo(3) == 0 ? upTo(255) : 100 + upTo(10));
    for (std::size_t i = 0; i < p.guide.pixels.size(); ++i) {
        // `base` is the first label of a pixel's window of labels. As in the search, it seldom
        // differs between neighbouring pixels.
        const int moved = upTo(2 * reach) - reach;
        p.base.push_back(static_cast<std::int16_t>(i > 0 && upTo(2) > 0 ? p.base.back() : moved));
        for (int k = 0; k < p.labels(); ++k)
            p.costs.push_back(static_cast<std::uint8_t>(upTo(greatest)));
    }
    return p;
}

std::vector<float> solve(const Problem& p, SemiGlobal& matcher, Workers& workers) {
    std::vector<Valley> found(p.guide.pixels.size());
    const std::size_t row = static_cast<std::size_t>(p.guide.size.width) * p.labels();
    matcher.run(
        p.guide, p.base, p.vectors, p.smoothness,
        [&](int y, std::uint8_t* costs) {
            std::copy_n(p.costs.begin() + static_cast<std::ptrdiff_t>(y * row), row, costs);
        },
        workers, found);
    std::vector<float> out(found.size());
    std::ranges::transform(found, out.begin(), vertexOf);
    return out;
}

std::vector<float> solve(const Problem& p, int threads) {
    Workers workers(threads);
    SemiGlobal matcher(p.guide.pixels.size() * p.vectors);
    return solve(p, matcher, workers);
}

/// Adds the path costs L in direction (dx, dy) to `sums`. For pixel p, label k and the previous
/// pixel q: L(p, k) = C(p, k) + min(L(q, k), L(q, k +- 1) + step, jump) - c(p). The constant c(p)
/// makes the least L(p, k) of all k zero. The label k is the same at p and q, even if their windows
/// begin with different labels.
void addPath(const Problem& p, int dx, int dy, std::vector<int>& sums) {
    const auto [w, h] = p.guide.size;
    const int labels = p.labels();
    std::vector<int> path(sums.size());
    for (int n = 0; n < w * h; ++n) {
        const int x = dx > 0 ? n % w : w - 1 - n % w, y = dy > 0 ? n / w : h - 1 - n / w;
        const bool starts = x - dx < 0 || x - dx >= w || y - dy < 0 || y - dy >= h;
        const std::size_t i = p.pixel(x, y), j = starts ? i : p.pixel(x - dx, y - dy);
        const auto before = [&](int label) {
            const int k = label - p.base[j];
            if (k < 0 || k >= labels) return 1000;
            return starts ? 0 : path[j * labels + k];
        };
        const int contrast = std::abs(p.guide.pixels[i] - p.guide.pixels[j]);
        const double edge = std::max(0.0, contrast - p.smoothness.noise);
        const int jump = static_cast<int>(
            std::max<double>(p.smoothness.step + 3, p.smoothness.jump * 8 / (8 + edge)));
        int least = 1000;
        for (int k = 0; k < labels; ++k) {
            const int label = p.base[i] + k;
            const int beside = std::min(before(label - 1), before(label + 1)) + p.smoothness.step;
            path[i * labels + k] =
                p.costs[i * labels + k] + std::min({before(label), beside, jump});
            least = std::min(least, path[i * labels + k]);
        }
        for (int k = 0; k < labels; ++k)
            sums[i * labels + k] += path[i * labels + k] -= least;
    }
}

std::vector<float> twin(const Problem& p) {
    const int labels = p.labels();
    std::vector<int> sums(p.costs.size());
    addPath(p, 1, 0, sums);
    addPath(p, -1, 0, sums);
    addPath(p, 0, 1, sums);
    addPath(p, 0, -1, sums);
    std::vector<float> out;
    for (std::size_t i = 0; i < p.guide.pixels.size(); ++i) {
        const int* s = sums.data() + i * labels;
        const int best = static_cast<int>(std::min_element(s, s + labels) - s);
        float label = static_cast<float>(p.base[i] + best);
        if (best > 0 && best + 1 < labels) {
            const int rise = std::max(s[best - 1], s[best + 1]) - s[best];
            if (rise > 0)
                label +=
                    0.5F * static_cast<float>(s[best - 1] - s[best + 1]) / static_cast<float>(rise);
        }
        out.push_back(label);
    }
    return out;
}

void expectTwin(const Problem& p) {
    const auto expected = twin(p);
    for (const int threads : {1, 3}) {
        const auto found = solve(p, threads);
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(found[i], expected[i])
                << "pixel " << i << " of " << p.guide.size.width << 'x' << p.guide.size.height
                << ", " << p.vectors << " vectors, " << threads << " threads";
    }
}

// The paths run only along the two axes, so addPath() may process pixels row by row.
TEST(SemiGlobal, MatchesTheOracleInOneWindow) {
    for (unsigned seed = 1; seed <= 4; ++seed)
        for (const Size size : {Size{1, 1}, Size{1, 9}, Size{11, 1}, Size{2, 3}, Size{37, 29}})
            expectTwin(randomProblem(size, 1, 0, seed));
}

TEST(SemiGlobal, MatchesTheOracleIfWindowsBeginWithDifferentLabels) {
    for (const int reach : {1, 5, 8, 16, 40, 300})
        for (unsigned seed = 1; seed <= 3; ++seed)
            expectTwin(randomProblem({41, 23}, 1, reach, seed));
}

TEST(SemiGlobal, MatchesTheOracleWithSeveralSimdVectorsOfLabels) {
    for (const int vectors : {2, 3, 5})
        for (const int reach : {0, 7, 17, 40})
            expectTwin(randomProblem({33, 19}, vectors, reach, 10 + vectors));
}

// Sums of path costs are largest if each cost is zero or the maximum and Smoothness::jump is at its
// upper limit.
TEST(SemiGlobal, SumsOfPathCostsFitIntoBytes) {
    for (const int step : {24, 30}) {
        Problem p = randomProblem({40, 40}, 1, 30, 1);
        p.smoothness = {step, 60, 255};
        std::mt19937 random(1);
        for (std::uint8_t& cost : p.costs)
            cost = random() % 8 == 0 ? 0 : 24;
        expectTwin(p);
    }
}

TEST(SemiGlobal, ALabelThatIsCheapestEverywhereWinsEverywhere) {
    for (int clear = 0; clear < 32; ++clear) {
        Problem p = randomProblem({20, 20}, 2, 0, 3);
        for (std::size_t i = 0; i < p.costs.size(); ++i)
            p.costs[i] = static_cast<int>(i % 32) == clear ? 0 : 24;
        for (const float label : solve(p, 2))
            ASSERT_NEAR(label, static_cast<float>(p.base[0] + clear), 1e-6F);
    }
}

// The surface rises by one label every second pixel. The windows of neighbouring pixels begin with
// different labels. Only paths that take this difference into account can follow the surface.
TEST(SemiGlobal, FollowsASlopeThroughMovingWindows) {
    Problem p = randomProblem({60, 24}, 1, 0, 3);
    p.smoothness = {12, 60, 255};
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 60; ++x) {
            const std::size_t i = p.pixel(x, y);
            const int truth = x / 2;
            p.base[i] = static_cast<std::int16_t>(truth - 3 - (x / 7 + y / 5) % 8);
            for (int k = 0; k < 16; ++k)
                p.costs[i * 16 + k] = (x + y) % 3 == 0 || p.base[i] + k == truth ? 4 : 20;
        }
    }
    const auto found = solve(p, 2);
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 60; ++x) {
            const int truth = x / 2;
            ASSERT_NEAR(found[p.pixel(x, y)], static_cast<float>(truth), 0.5F) << x << ',' << y;
        }
    }
}

// Costs are proportional to |k - truth|. For such costs, the vertex of a fitted parabola would be
// biased towards whole labels.
TEST(SemiGlobal, SubLabelPartIsTheVertexOfTwoLines) {
    for (const int quarter : {-2, -1, 0, 1, 2}) {
        Problem p = randomProblem({1, 1}, 1, 0, 3);
        for (int k = 0; k < 16; ++k)
            p.costs[k] = static_cast<std::uint8_t>(std::min(24, std::abs(4 * (k - 8) - quarter)));
        EXPECT_FLOAT_EQ(solve(p, 1)[0], 8 + 0.25F * static_cast<float>(quarter));
    }
}

TEST(SemiGlobal, TheResultDoesNotDependOnTheNumberOfThreads) {
    const Problem p = randomProblem({150, 70}, 2, 20, 77);
    const auto one = solve(p, 1);
    for (int threads = 2; threads <= 4; ++threads)
        EXPECT_EQ(solve(p, threads), one);
}

TEST(SemiGlobal, CanBeReusedForSmallerProblems) {
    Workers workers(2);
    SemiGlobal matcher(40UL * 30 * 3);
    for (const Problem& p : {randomProblem({40, 30}, 3, 20, 1), randomProblem({20, 15}, 1, 20, 2),
                             randomProblem({40, 30}, 2, 20, 3)})
        EXPECT_EQ(solve(p, matcher, workers), twin(p));
}

}  // namespace
}  // namespace mfar
