#include "tests/engine/gl_test.h"
#include "tests/engine/surfaces.h"
#include "tests/oracle/flow_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mfar {
namespace {

/// Decides whether a cell's choice agrees with the oracle. If rounding can change which of two
/// errors is smaller, both choices agree.
class Choices {
public:
    Choices(const twin::SubpixelCase& in, int x, int y)
        : in_(in), x_(x), y_(y), steps_(twin::flowSteps(in, x, y)) {
        if (steps_.empty()) return;
        own_ = errorAt(in.index(x, y));
        for (const std::size_t n : steps_)
            least_ = std::min(least_, errorAt(n));
    }

    [[nodiscard]] bool hasStep() const { return !steps_.empty(); }
    [[nodiscard]] bool mayKeep() const { return !steps_.empty() ? !wins(least_, -1) : true; }
    /// `flow` must be that of a neighbour, bit for bit.
    [[nodiscard]] bool mayTake(const Eigen::Vector2d& flow) const {
        return std::ranges::any_of(steps_, [&](std::size_t n) {
            const double error = in_.flow[n] == flow ? errorAt(n) : kOutside;
            return wins(error, 1) && error - least_ < roundingOf(least_);
        });
    }

private:
    static constexpr double kOutside = std::numeric_limits<double>::infinity();

    [[nodiscard]] double errorAt(std::size_t cell) const {
        const Eigen::Vector2d& flow = in_.flow[cell];
        return twin::isShown(in_, x_, y_, flow) ? twin::choiceError(in_, x_, y_, flow) : kOutside;
    }
    /// Each luma is exact to about 0.3 grey levels.
    static double roundingOf(double error) { return 2 * 0.3 * 4 * std::sqrt(error) + 2; }
    /// Returns true if a neighbour's error is clearly better than the cell's own. `sign`: 1 assumes
    /// that rounding favours the neighbour, -1 that it favours the cell.
    [[nodiscard]] bool wins(double error, double sign) const {
        if (!(error < kOutside && own_ < kOutside)) return false;
        const double noise = twin::choiceNoise(in_);
        const double change = sign * (roundingOf(error) + roundingOf(own_));
        return error + noise < params::kClearlyBetter * (own_ + noise) + change;
    }

    const twin::SubpixelCase& in_;
    int x_, y_;
    std::vector<std::size_t> steps_;
    double own_ = 0, least_ = kOutside;
};

struct Counts {
    int keep = 0, take = 0;  ///< number of cells with a step that keep their flow or take another
};

/// Compares the flow that the cells choose with the oracle's.
Counts expectTheOraclesChoice(const Surfaces& in, const Surfaces& chosen, bool usesErrors,
                              float light) {
    const twin::SubpixelCase oracle = oracleOf(in, usesErrors, light);
    Counts counts;
    for (int y = 0; y < in.cells.height; ++y)
        for (int x = 0; x < in.cells.width; ++x) {
            const FlowCell &was = in.given[in.index(x, y)], &is = chosen.given[in.index(x, y)];
            EXPECT_EQ(is.cost, was.cost);
            EXPECT_EQ(is.texture, was.texture);
            const Choices choices(oracle, x, y);
            const bool keeps = is.x == was.x && is.y == was.y;
            EXPECT_TRUE(keeps ? choices.mayKeep() : choices.mayTake({is.x, is.y}))
                << x << ", " << y << (keeps ? " keeps its flow" : " takes another flow");
            if (choices.hasStep()) ++(keeps ? counts.keep : counts.take);
        }
    return counts;
}

std::vector<Surfaces> chosenOnBoth(const Surfaces& in, bool usesErrors = true, float light = 0) {
    return {chosenOnHost(in, usesErrors, light), chosenOnGpu(in, usesErrors, light)};
}

/// The exact flow of each cell's surface, but confused at the edge.
Surfaces exactButConfused() {
    Surfaces out;
    for (int y = 0; y < out.cells.height; ++y)
        for (int x = 0; x < out.cells.width; ++x) {
            const Eigen::Vector2f flow = surfaceFlow(middleOf(x, y)).cast<float>();
            FlowCell& cell = out.given[out.index(x, y)];
            cell.x = flow.x();
            cell.y = flow.y();
        }
    for (ErrorCell& error : out.errors)
        error.error = 0;
    out.confuse();
    return out;
}

using FlowChoiceEngines = GlTest;

TEST_F(FlowChoiceEngines, BothEnginesMatchTheOracle) {
    Surfaces in;
    in.confuse();
    for (const bool usesErrors : {true, false})
        for (const float light : {0.0F, 1.5F})
            for (const Surfaces& chosen : chosenOnBoth(in, usesErrors, light)) {
                const Counts counts = expectTheOraclesChoice(in, chosen, usesErrors, light);
                EXPECT_GT(counts.take, 12);
                EXPECT_GT(counts.keep, 40);
            }
}

TEST_F(FlowChoiceEngines, BothEnginesMatchTheOracleInPicturesOfAnySize) {
    int taken = 0;
    for (const Size video : {Size{16, 16}, {17, 19}, {61, 45}, {256, 64}}) {
        SCOPED_TRACE(video.width);
        Surfaces in(video);
        for (std::size_t i = 0; i < in.given.size(); i += 7)
            in.given[i].x += 2;
        for (const Surfaces& chosen : chosenOnBoth(in))
            taken += expectTheOraclesChoice(in, chosen, true, 0).take;
    }
    EXPECT_GT(taken, 100);
}

TEST_F(FlowChoiceEngines, CellsBesideAnEdgeGetTheFlowOfTheirSurfaceAndOthersKeepTheirs) {
    const Surfaces in = exactButConfused();
    for (const Surfaces& chosen : chosenOnBoth(in)) {
        int replaced = 0;
        // The still does not show the first row.
        for (int y = 1; y < in.cells.height - 1; ++y)
            for (int x = 0; x < in.cells.width - 1; ++x) {
                const FlowCell &was = in.given[in.index(x, y)], &is = chosen.given[in.index(x, y)];
                if (x == kEdge && in.errorOf(was, x, y) > 1 && in.isMatched(x, y)) {
                    EXPECT_LT(in.errorOf(is, x, y), 0.2) << y;
                    ++replaced;
                } else {
                    EXPECT_EQ(is.x, was.x) << x << ", " << y;
                    EXPECT_EQ(is.y, was.y) << x << ", " << y;
                }
            }
        EXPECT_GT(replaced, 10);
    }
}

TEST_F(FlowChoiceEngines, AnInvalidFlowIsNeverChosen) {
    constexpr int kY = 6;
    const float nan = std::nanf("");
    for (const auto& [x, y] : {std::pair{nan, 0.0F},
                               {0.0F, nan},
                               {nan, nan},
                               {3e38F, 0.0F},
                               {-1e3F, 0.0F},
                               {0.0F, 1e3F}}) {
        Surfaces in = exactButConfused();
        ASSERT_TRUE(in.isMatched(kEdge, kY) && in.isMatched(kEdge + 1, kY));
        for (const int row : {kY - 1, kY, kY + 1}) {
            FlowCell& cell = in.given[in.index(kEdge + 1, row)];
            cell.x = x;
            cell.y = y;
        }
        // Now, only the cell below has the flow of the right surface.
        for (const Surfaces& chosen : chosenOnBoth(in)) {
            const FlowCell& got = chosen.given[in.index(kEdge, kY)];
            EXPECT_LT(in.errorOf(got, kEdge, kY), 0.2) << x << ", " << y;
            const FlowCell& invalid = chosen.given[in.index(kEdge + 1, kY)];
            EXPECT_TRUE(std::isnan(x) ? std::isnan(invalid.x) : invalid.x == x || x == 0) << x;
        }
    }
}

TEST_F(FlowChoiceEngines, NoiseKeepsTheOwnFlow) {
    Surfaces in = exactButConfused();
    const auto changed = [&] {
        std::vector<int> out;
        for (const Surfaces& chosen : chosenOnBoth(in)) {
            out.push_back(0);
            for (std::size_t i = 0; i < in.given.size(); ++i)
                out.back() += chosen.given[i].x != in.given[i].x ? 1 : 0;
        }
        return out;
    };
    for (const int count : changed())
        EXPECT_GT(count, 10);
    in.work.noise = 100;
    for (const int count : changed())
        EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace mfar
