#include "pipeline/engine/params/weigh.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/weigh_step.h"
#include "tests/engine/simd/luma_memory.h"
#include "tests/oracle/patch.h"
#include "tests/oracle/superres.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <memory>
#include <random>

namespace mfar::simd {
namespace {

using Eigen::Vector2d;

constexpr double kVideoNoise = 1.5, kAlpha = params::kTwoWayAlpha;
constexpr float kNoFlow = std::numeric_limits<float>::quiet_NaN();
constexpr float kEndless = std::numeric_limits<float>::infinity();

double wavy(double x, double y) {
    const double contrast = std::min(0.02 * x * x, 50.0);
    return 128 +
           contrast * (std::sin(0.9 * x + 0.2 * y) * std::cos(0.7 * y) + 0.4 * std::sin(1.7 * x));
}

struct WeighCase {
    WeighCase(Size video, Size still, bool distort, int backwardLevel)
        : rig(test::twoLenses(video, still, distort)),
          luma(
              video, [](int x, int y) { return wavy(x, y); },
              [](int x, int y) { return 20 + 0.8 * wavy(x - 2.3, y + 1.4); }),
          cells(cellsOf(video)), level(backwardLevel), forward(cells),
          backward({std::max(cells.width >> level, 1), std::max(cells.height >> level, 1)}),
          errors(cells), step(rig, nullptr) {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> near(-0.6F, 0.6F), wide(-12, 12);
        for (int y = 0; y < cells.height; ++y)
            for (int x = 0; x < cells.width; ++x) {
                const bool far = (x + y) % 5 == 0 && y % 4 < 2;
                const float bend = 0.04F * static_cast<float>(y % 6);
                const bool front = x >= cells.width / 2 && y >= cells.height / 2;
                const float u = (front ? 7.3F : 2.3F) + bend * static_cast<float>(x % 4);
                forward[y][x] = {far ? wide(random) : u, far ? wide(random) : -1.4F + bend, 0, 0};
                errors[y][x] = {std::abs(wide(random)) / 3};
            }
        const auto scale = static_cast<float>(1 << level);
        for (int y = 0; y < backward.size().height; ++y)
            for (int x = 0; x < backward.size().width; ++x)
                backward[y][x] = {(near(random) - 2.3F) / scale, (near(random) + 1.4F) / scale};
        work.tiles = tilesOf(video);
        work.flags.assign(static_cast<std::size_t>(work.tiles.width) * work.tiles.height, {1, 1});
        work.changed = work.matched = static_cast<int>(work.flags.size());
        work.noise = kVideoNoise;
    }

    void run(bool givenErrors = false) { run(step, givenErrors); }
    void run(WeighStep& on, bool givenErrors = false) {
        on.run({luma.videoLuma(), luma.stillLuma(), luma.words(), forward.rows(), backward.rows(),
                level, givenErrors ? errors.rows() : Rows<ErrorCell>{}, work});
    }

    StereoRig rig;
    test::LumaMemory luma;
    Size cells;
    int level;
    AlignedRows<FlowCell> forward, backward;
    AlignedRows<ErrorCell> errors;
    TileWork work;
    WeighStep step;
};

class WeighOracle {
public:
    WeighOracle(const WeighCase& c, bool givenErrors) : case_(c), givenErrors_(givenErrors) {
        const Size video = c.rig.video.size;
        half_.size = cellsOf({(video.width + 1) / 2, (video.height + 1) / 2});
        flow_.size = statistics_.size = backward_.size = c.cells;
        backward_.size = c.backward.size();
        for (int y = 0; y < backward_.size.height; ++y)
            for (int x = 0; x < backward_.size.width; ++x)
                put(backward_, {c.backward[y][x].x, c.backward[y][x].y, 0, 0});
        for (int y = 0; y < c.cells.height; ++y)
            for (int x = 0; x < c.cells.width; ++x)
                assess(x, y);
        for (int y = 0; y < half_.size.height; ++y)
            for (int x = 0; x < half_.size.width; ++x)
                measureGain(x, y);
    }

    [[nodiscard]] twin::Weight at(int x, int y) const {
        return twin::weigh(flow_, statistics_, half_, x, y, kVideoNoise);
    }
    [[nodiscard]] double jumpsAt(int x, int y) const { return twin::jumpsAt(flow_, x, y); }
    [[nodiscard]] Vector2d lookUp(int x, int y) const {
        const StereoRig& rig = case_.rig;
        const Eigen::Array2d scale(rig.still.fx / rig.video.fx, rig.still.fy / rig.video.fy);
        const Eigen::Array2d scaled = scale * (centre(x, y).array() + 0.5) - 0.5;
        return twin::stillPixel(rig, centre(x, y) + flowAt(x, y)) - scaled.matrix();
    }

private:
    static void put(twin::Cells& to, std::array<double, 4> v) {
        for (const double value : v)
            to.values.push_back(static_cast<float>(value));
    }
    static Vector2d centre(int x, int y) { return {4 * x + 1.5, 4 * y + 1.5}; }
    static bool inside(const Vector2d& p, Size size) {
        return p.x() >= 0 && p.y() >= 0 && p.x() <= size.width - 1 && p.y() <= size.height - 1;
    }
    [[nodiscard]] Vector2d flowAt(int x, int y) const {
        return {case_.forward[y][x].x, case_.forward[y][x].y};
    }
    [[nodiscard]] double confidence(int x, int y) const {
        const Vector2d u = flowAt(x, y), q = centre(x, y) + u;
        if (!inside(q, case_.rig.video.size) ||
            !inside(twin::stillPixel(case_.rig, q), case_.rig.still.size))
            return 0;
        if (givenErrors_) return 1 - std::min(case_.errors[y][x].error / kAlpha, 1.0);
        const double scale = 1 << case_.level, cell = 4 * scale;
        return twin::confidence(
            u,
            scale * backward_.bilinear((q.x() + 0.5) / cell - 0.5, (q.y() + 0.5) / cell - 0.5)
                        .head<2>(),
            kAlpha);
    }
    [[nodiscard]] bool matched(int tileX, int tileY) const {
        return case_.work.at(tileX, tileY).matched != 0;
    }
    void assess(int x, int y) {
        const Vector2d u = flowAt(x, y);
        put(flow_, {u.x(), u.y(), 0, 0});
        if (!matched(x / 4, y / 4)) return put(statistics_, {0, 0, 0, confidence(x, y)});
        const auto m = twin::comparePatch(case_.luma.video(0), case_.luma.still(0), x, y, u);
        put(statistics_, {m.covariance, m.varianceA, m.varianceB, confidence(x, y)});
    }
    void measureGain(int x, int y) {
        if (!matched(x / 2, y / 2)) return put(half_, {0, 0, 0, 0});
        const Eigen::Vector4d sum = flow_.at(2 * x, 2 * y) + flow_.at(2 * x + 1, 2 * y) +
                                    flow_.at(2 * x, 2 * y + 1) + flow_.at(2 * x + 1, 2 * y + 1);
        const auto m =
            twin::comparePatch(case_.luma.video(1), case_.luma.still(1), x, y, sum.head<2>() / 8);
        put(half_, {m.covariance, m.varianceA, m.varianceB, 0});
    }

    const WeighCase& case_;
    bool givenErrors_;
    twin::Cells flow_, statistics_, half_, backward_;
};

void expectOracle(const WeighCase& c, bool givenErrors) {
    const WeighOracle oracle(c, givenErrors);
    for (int y = 0; y < c.cells.height; ++y)
        for (int x = 0; x < c.cells.width; ++x) {
            SCOPED_TRACE(testing::Message() << "cell " << x << ", " << y);
            const twin::Weight t = oracle.at(x, y);
            const WeighedCell& w = c.step.weighed()[y][x];
            const LookUpCell& l = c.step.lookUps()[y][x];
            const TrustCell& trust = c.step.trust()[y][x];
            EXPECT_EQ(w.x, c.forward[y][x].x);
            EXPECT_EQ(w.y, c.forward[y][x].y);
            // Tolerance: the kernels round pixels to 1/64 grey level, which changes the covariance
            // by up to 0.1 %. At low contrast, a weight grows with the covariance's fifth power. A
            // weight below kSmallestWeight is set to 0. So near this limit, one of the two weights
            // can be 0 and the other not.
            EXPECT_NEAR(w.weight, t.weight,
                        w.weight == 0 || t.weight == 0 ? 1.001 * params::kSmallestWeight
                                                       : 2e-3 * t.weight + 1e-4);
            if (w.weight == 0 || t.weight == 0) {
                EXPECT_LE(t.weight, 1.001 * params::kSmallestWeight);
            }
            EXPECT_NEAR(w.confidence, t.confidence, 1e-4);
            EXPECT_EQ(l.weight, w.weight);
            EXPECT_NEAR(l.confidenceAndJumps, w.confidence + oracle.jumpsAt(x, y), 1e-6);
            EXPECT_LE((Vector2d(l.x, l.y) - oracle.lookUp(x, y)).norm(), 0.01);
            EXPECT_EQ(trust.halfWeight, std::min(w.weight / 2, 1.0F));
            EXPECT_EQ(trust.confidence, w.confidence);
            EXPECT_NEAR(trust.signal, t.signal, 1e-3);
            EXPECT_EQ(trust.unexplained, t.unexplained);
            EXPECT_NEAR(c.step.surface().variance[y][x], t.variance, 2e-3 * t.variance + 0.01);
        }
}

struct Shape {
    Size video, still;
    bool distort;
    int backwardLevel;
};

class WeighShapes : public testing::TestWithParam<Shape> {};

TEST_P(WeighShapes, WeightsOfEveryCellMatchTheOracle) {
    const Shape& s = GetParam();
    WeighCase c(s.video, s.still, s.distort, s.backwardLevel);
    for (const bool givenErrors : {false, true}) {
        c.run(givenErrors);
        expectOracle(c, givenErrors);
    }
}

TEST_P(WeighShapes, TilesThatAreNotMatchedHaveNoStatistics) {
    const Shape& s = GetParam();
    WeighCase c(s.video, s.still, s.distort, s.backwardLevel);
    for (std::size_t i = 0; i < c.work.flags.size(); ++i)
        c.work.flags[i].matched = i * i % 7 < 3 ? 1 : 0;
    c.run();
    expectOracle(c, false);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, WeighShapes,
    testing::Values(Shape{{61, 45}, {220, 163}, true, 0}, Shape{{61, 45}, {220, 163}, true, 1},
                    Shape{{16, 16}, {16, 16}, false, 0}, Shape{{17, 83}, {50, 249}, false, 2},
                    Shape{{149, 37}, {300, 75}, true, 1}, Shape{{128, 64}, {512, 256}, false, 0}));

WeighCase plainCase() {
    return {{93, 61}, {340, 223}, true, 0};
}

template <class T>
std::vector<T> copied(Rows<const T> rows) {
    std::vector<T> out;
    for (int y = 0; y < rows.size.height; ++y)
        out.insert(out.end(), rows[y], rows[y] + rows.size.width);
    return out;
}

template <class T>
bool same(Rows<const T> rows, const std::vector<T>& values) {
    const std::vector<T> now = copied(rows);
    return now.size() == values.size() &&
           std::memcmp(now.data(), values.data(), sizeof(T) * values.size()) == 0;
}

TEST(WeighStep, ResultsDoNotDependOnTheNumberOfThreads) {
    WeighCase c({149, 83}, {300, 170}, true, 0);
    c.run();
    for (const int threads : {1, 2, 3}) {
        WeighStep threaded(c.rig, std::make_shared<Workers>(threads));
        c.run(threaded);
        EXPECT_TRUE(same(threaded.weighed(), copied(c.step.weighed())));
        EXPECT_TRUE(same(threaded.lookUps(), copied(c.step.lookUps())));
        EXPECT_TRUE(same(threaded.trust(), copied(c.step.trust())));
    }
}

TEST(WeighStep, EdgesOfSurfacesAreMarked) {
    WeighCase c = plainCase();
    c.run();
    twin::Cells flow{.size = c.cells, .values = {}};
    for (int y = 0; y < c.cells.height; ++y)
        for (int x = 0; x < c.cells.width; ++x)
            for (const float value : {c.forward[y][x].x, c.forward[y][x].y, 0.0F, 0.0F})
                flow.values.push_back(value);
    int kinks = 0;
    for (int y = 0; y < c.cells.height; ++y)
        for (int x = 0; x < c.cells.width; ++x) {
            const double wanted = twin::kinkAt(flow, x, y);
            ASSERT_NEAR(c.step.surface().kink[y][x], wanted, 1e-4 * (1 + wanted)) << x << ", " << y;
            kinks += wanted > params::kSharpKink ? 1 : 0;
        }
    EXPECT_GT(kinks, 20);
    EXPECT_LT(kinks, c.cells.width * c.cells.height - 20);
}

TEST(WeighStep, ConfirmedWeightsBelowOneAreRaised) {
    WeighCase c = plainCase();
    c.run();
    const std::vector<WeighedCell> before = copied(c.step.weighed());
    AlignedRows<float> shares(c.cells);
    for (int y = 0; y < c.cells.height; ++y)
        for (int x = 0; x < c.cells.width; ++x)
            shares[y][x] = x % 2 == 0 ? 1.0F : 0.5F;
    c.step.confirm(shares.rows());
    int small = 0, large = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const int x = static_cast<int>(i) % c.cells.width, y = static_cast<int>(i) / c.cells.width;
        const float w = before[i].weight, weight = c.step.weighed()[y][x].weight;
        const double raised = w < 1 ? 1 - std::pow(1.0 - w, 4) : w;
        EXPECT_NEAR(weight, raised * shares[y][x], 1e-6);
        EXPECT_EQ(c.step.lookUps()[y][x].weight, weight);
        EXPECT_EQ(c.step.trust()[y][x].halfWeight, std::min(0.5F * weight, 1.0F));
        small += w > 0 && w < 1 ? 1 : 0;
        large += w > 1 ? 1 : 0;
    }
    EXPECT_GT(small, 20);
    EXPECT_GT(large, 20);
}

TEST(WeighStep, WithoutChangedTilesNothingIsComputed) {
    WeighCase c = plainCase();
    c.run();
    const auto before = copied(c.step.weighed());
    for (int x = 0; x < c.cells.width; ++x)
        c.forward[3][x] = {9, 9, 0, 0};
    c.work.changed = c.work.matched = 0;
    c.run();
    EXPECT_TRUE(same(c.step.weighed(), before));
}

// Weights also depend on the photometric gain between the sensors at half resolution, see
// params::kLowContrast. This gain must not change if no changed tile is matched, even if the flow
// changes.
TEST(WeighStep, TheGainStaysIfNoChangedTileIsMatched) {
    WeighCase kept = plainCase(), renewed = plainCase(), first = plainCase();
    kept.run();
    renewed.run();
    for (WeighCase* c : {&kept, &renewed, &first})
        for (int y = 0; y < c->cells.height; ++y)
            for (int x = 0; x < c->cells.width; ++x)
                c->forward[y][x].x += 1;
    kept.work.matched = 0;
    kept.run();
    renewed.run();
    first.run();
    EXPECT_TRUE(same(first.step.weighed(), copied(renewed.step.weighed())));
    EXPECT_FALSE(same(kept.step.weighed(), copied(renewed.step.weighed())));
}

TEST(WeighStep, FlowThatIsNotFiniteHasNoWeightAndAffectsOnlyItsNeighbours) {
    const WeighCase clean = [] {
        WeighCase c = plainCase();
        c.run();
        return c;
    }();
    for (const float bad : {kNoFlow, kEndless, -kEndless, 1e30F, -3e38F}) {
        WeighCase c = plainCase();
        c.forward[5][7] = {bad, 1, 0, 0};
        c.forward[6][12] = {0, bad, 0, 0};
        c.run();
        int alike = 0;
        for (int y = 0; y < c.cells.height; ++y)
            for (int x = 0; x < c.cells.width; ++x) {
                const WeighedCell &w = c.step.weighed()[y][x], &k = clean.step.weighed()[y][x];
                const LookUpCell& l = c.step.lookUps()[y][x];
                const TrustCell& t = c.step.trust()[y][x];
                const bool isBad = (x == 7 && y == 5) || (x == 12 && y == 6);
                if (isBad) {
                    EXPECT_EQ(w.confidence, 0);
                    EXPECT_EQ(w.weight, 0);
                }
                for (const float value :
                     {w.weight, w.confidence, l.x, l.y, t.signal, t.unexplained})
                    EXPECT_TRUE(std::isfinite(value)) << x << ", " << y << " by " << bad;
                const bool isNear = std::abs(x - 7) < 4 || std::abs(x - 12) < 4;
                if (!isNear) {
                    EXPECT_EQ(w.weight, k.weight) << x << ", " << y;
                }
                alike += !isNear && w.weight > 0 ? 1 : 0;
            }
        EXPECT_GT(alike, 10);
    }
}

TEST(WeighStep, TwoWayErrorsThatAreNanGiveNoConfidence) {
    WeighCase c = plainCase();
    c.errors[4][4] = {kNoFlow};
    c.errors[4][5] = {kEndless};
    c.errors[4][6] = {0};
    c.run(true);
    EXPECT_EQ(c.step.weighed()[4][4].confidence, 0);
    EXPECT_EQ(c.step.weighed()[4][5].confidence, 0);
    EXPECT_EQ(c.step.weighed()[4][6].confidence, 1);
}

}  // namespace
}  // namespace mfar::simd
