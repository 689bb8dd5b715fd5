#include "tests/measure/train/enlarger_training.h"

#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <cmath>

namespace mfar::train {
namespace {

using namespace enlarge;

constexpr int kBorder = 12;           // pixels of a picture that are left out
constexpr double kLeastPixels = 400;  // of a class, to learn and to check

FilterBank::Filter rounded(const Eigen::Matrix<double, kTaps, kPhases>& weights) {
    FilterBank::Filter out;
    for (int tap = 0; tap < kTaps; ++tap)
        for (int phase = 0; phase < kPhases; ++phase) {
            const double value = std::round(weights(tap, phase) * kWeightScale / 2);
            out[filterIndex(tap, phase)] =
                static_cast<std::int16_t>(std::clamp(value, -32767.0, 32767.0));
        }
    return out;
}

}  // namespace

EnlargerTraining::EnlargerTraining() {
    Sums none;
    none.taps.setZero();
    none.products.setZero();
    learned_.assign(kUnique, none);
    checked_.assign(kUnique, none);
}

void EnlargerTraining::accumulate(Sums& sums, const Taps& steps, const Phases& target,
                                  const Symmetry& same) {
    Taps f;
    Phases t;
    for (int i = 0; i < kTaps; ++i)
        f[same.tap(i)] = steps[i];
    for (int i = 0; i < kPhases; ++i)
        t[same.phase(i)] = target[i];
    sums.taps.noalias() += f * f.transpose();
    sums.products.noalias() += f * t.transpose();
    sums.squares += t.squaredNorm();
    ++sums.pixels;
}

void EnlargerTraining::add(const TrainingPair& pair, bool heldOut) {
    std::vector<Sums>& to = heldOut ? checked_ : learned_;
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
            using G = GradientClasses;
            using C = CurvatureClasses;
            const auto gradient = Symmetry::of(numbers[0][x] / G::kKinds, G::kAngles);
            accumulate(to[gradient.unique * G::kKinds + numbers[0][x] % G::kKinds], steps, target,
                       gradient);
            const auto curvature = Symmetry::of(numbers[1][x] / C::kKinds, C::kAngles);
            accumulate(
                to[kUniqueGradient + curvature.unique * C::kKinds + numbers[1][x] % C::kKinds],
                steps, target, curvature);
        }
    }
}

/// With the same pictures turned by 180 degrees, which have the same classes.
EnlargerTraining::Sums EnlargerTraining::turnedToo(const Sums& sums) {
    Sums out = sums;
    const auto turned = [](int tap) { return tapAt({-kTapAt[tap].x, -kTapAt[tap].y}); };
    for (int i = 0; i < kTaps; ++i) {
        for (int j = 0; j < kTaps; ++j)
            out.taps(i, j) += sums.taps(turned(i), turned(j));
        for (int j = 0; j < kPhases; ++j)
            out.products(i, j) += sums.products(turned(i), kPhases - 1 - j);
    }
    out.squares *= 2;
    return out;
}

double EnlargerTraining::errorOf(const Sums& sums, const Weights& weights) {
    return sums.squares - 2 * weights.cwiseProduct(sums.products).sum() +
           weights.cwiseProduct(sums.taps * weights).sum();
}

EnlargerTraining::Outcome EnlargerTraining::solve(double ridge) const {
    Outcome out;
    for (int i = 0; i < kUnique; ++i) {
        const Sums learned = turnedToo(learned_[i]), checked = turnedToo(checked_[i]);
        auto taps = learned.taps;
        taps.diagonal().array() += ridge;
        Weights weights = taps.llt().solve(learned.products);
        const bool enough = learned.pixels >= kLeastPixels && checked.pixels >= kLeastPixels;
        if (!enough || !(errorOf(checked, weights) < checked.squares)) weights.setZero();
        const int by = i < kUniqueGradient ? 0 : 1;
        out.cubicError[by] += checked.squares;
        out.error[by] += errorOf(checked, weights);
        out.used += weights.isZero(0) ? 0 : 1;
        out.filters.push_back(rounded(weights));
    }
    return out;
}

}  // namespace mfar::train
