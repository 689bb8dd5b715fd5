#include "tests/measure/train/enlarger_training.h"

#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <cmath>

namespace mfar::train {
namespace {

using namespace enlarge;

constexpr int kBorder = 12;
// Smallest number of pixels for learning a class, and for checking it.
constexpr double kLeastPixels = 400;

}  // namespace

EnlargerTraining::EnlargerTraining() : learned_(kUnique), checked_(kUnique) {}

void EnlargerTraining::accumulate(std::vector<ClassSums>& to, const UniqueClass& of,
                                  const Taps& steps, const Phases& target) {
    Taps f;
    Phases t;
    for (int i = 0; i < kTaps; ++i)
        f[of.same.tap(i)] = steps[i];
    for (int i = 0; i < kPhases; ++i)
        t[of.same.phase(i)] = target[i];
    to[of.number].add(f, t);
}

void EnlargerTraining::add(const TrainingPair& pair, bool heldOut) {
    std::vector<ClassSums>& to = heldOut ? checked_ : learned_;
    const auto [width, height] = pair.size();
    AlignedRows<float> sums({width + 2 * TrainingPair::kMargin, 3});
    AlignedRows<std::uint16_t> numbers({width, 2});
    const auto scratch = [&](int i) { return sums[i] + TrainingPair::kMargin; };
    for (int y = kBorder; y < height - kBorder; ++y) {
        std::array<const std::int16_t*, 7> rows{};
        for (int k = 0; k < 7; ++k)
            rows[k] = pair.row(y + k - 3);
        simd::classRow(rows, 0, width, {scratch(0), scratch(1), scratch(2)}, numbers[0],
                       numbers[1]);
        for (int x = kBorder; x < width - kBorder; ++x) {
            Taps steps;
            for (int i = 0; i < kTaps; ++i)
                steps[i] = double(rows[3 + kTapAt[i].y][x + kTapAt[i].x] - rows[3][x]) / kLumaScale;
            Phases target;
            for (int i = 0; i < kPhases; ++i)
                target[i] = pair.target(kGrid * x + i % kGrid, kGrid * y + i / kGrid);
            accumulate(to, uniqueByGradient(numbers[0][x]), steps, target);
            accumulate(to, uniqueByCurvature(numbers[1][x]), steps, target);
        }
    }
}

EnlargerTraining::Outcome EnlargerTraining::solve(double ridge) const {
    Outcome out;
    for (int i = 0; i < kUnique; ++i) {
        const ClassSums learned = learned_[i].turnedToo(), checked = checked_[i].turnedToo();
        auto taps = learned.taps;
        taps.diagonal().array() += ridge;
        ClassWeights weights = taps.llt().solve(learned.products);
        const bool enough = learned.pixels >= kLeastPixels && checked.pixels >= kLeastPixels;
        if (!enough || !(checked.errorOf(weights) < checked.squares)) weights.setZero();
        const int by = i < kUniqueGradient ? 0 : 1;
        out.cubicError[by] += checked.squares;
        out.error[by] += checked.errorOf(weights);
        out.used += weights.isZero(0) ? 0 : 1;
        out.filters.push_back(roundedFilter(weights));
    }
    return out;
}

}  // namespace mfar::train
