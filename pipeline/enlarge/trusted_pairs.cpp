#include "pipeline/enlarge/trusted_pairs.h"

#include "pipeline/enlarge/box_sums.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace mfar::enlarge {
namespace {

constexpr int kBorder = 8;  // unused border of the picture [video px]
// A pixel is trusted if the mean squared difference between video and still around it is at most
// the noise plus kMostDifference times the video's variance there. A factor of 0.1 would also trust
// inexact look-ups, which blur the still, and would cost 0.07 dB on photographs.
constexpr double kMostDifference = 0.03;
constexpr double kLeastNoise = 1;  // lower limit of the noise variance [grey levels^2]
constexpr int kTrustReach = 3;     // trust() averages over 7x7 pixels
constexpr int kMeanReach = 8;
constexpr double kMostShift = 0.5;  // largest correction of a look-up along each axis [video px]
// A video pixel has structure if the cubic enlargement has at least this variance within the pixel
// [grey levels^2].
constexpr double kStructure = 36;

/// Returns the largest mean squared difference between video and still that noise alone causes: 1.5
/// times the 20 % quantile of `differences`, which are means over 7x7 pixels. The differences at
/// this quantile come from noise only. The factor 1.5 is a margin for pixels with more noise.
double noiseOf(std::vector<double>& differences) {
    if (differences.empty()) return kLeastNoise;
    const auto fifth = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 5);
    std::nth_element(differences.begin(), fifth, differences.end());
    return std::max(kLeastNoise, 1.5 * *fifth);
}

// Weights of fitBlur(). The last one is Guidance::light. The first one belongs to the pixel itself
// and is not used.
constexpr int kWeights = 7, kLight = 6;
using Weights = Eigen::Matrix<double, kWeights, 1>;
using WeightSquares = Eigen::Matrix<double, kWeights, kWeights>;

/// Returns the index of a kernel's weight. Offsets that a rotation by 90 degrees or a reflection
/// maps onto each other share a weight.
int weightOf(int dx, int dy) {
    const int a = std::max(std::abs(dx), std::abs(dy)), b = std::min(std::abs(dx), std::abs(dy));
    return a * (a + 1) / 2 + b;
}

/// Solves the normal equations. If Guidance::light is out of range, returns the best weights with
/// the nearest value in range.
Weights bestWeights(const WeightSquares& squares, const Weights& products) {
    Weights out = squares.llt().solve(products);
    const double light = std::clamp(out[kLight], 0.0, double(Guidance::kMost));
    if (light == out[kLight]) return out;
    out.head<kLight>() = squares.topLeftCorner<kLight, kLight>().llt().solve(
        products.head<kLight>() - light * squares.col(kLight).head<kLight>());
    out[kLight] = light;
    return out;
}

}  // namespace

TrustedPairs::TrustedPairs(const MatchedPictures& pictures, std::stop_token stop)
    : in_(pictures), stop_(std::move(stop)), video_(pictures.video),
      cells_(pictures.lookUps.size()), lookUps_(cells_), known_(cells_), trusted_(video_),
      still_(video_), seen_(static_cast<std::size_t>(video_.width) * video_.height),
      mean_(seen_.size()) {
    findCells();
    still_.warp(in_, lookUps_, known_, stop_);
    fitTone();
    fitBlur();
    fitMean();
    shift();
    still_.warp(in_, lookUps_, known_, stop_);
    fitTone();
    fitBlur();
    fitMean();
    if (stop_.stop_requested()) return;
    trust();
    measureSharpness();
}

void TrustedPairs::findCells() {
    for (int y = 0; y < cells_.height; ++y)
        for (int x = 0; x < cells_.width; ++x) {
            const LookUpCell& cell = in_.lookUps[y][x];
            lookUps_[y][x] = cell;
            known_[y][x] = mayTeach(cell);
        }
}

double TrustedPairs::videoAt(int x, int y) const {
    return in_.row(y)[x] / double(kLumaScale);
}

/// Fits the tone curve: the video's grey level as a function of the still's grey level.
void TrustedPairs::fitTone() {
    toneSums_ = {};
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x)
            if (known_[y / kCell][x / kCell] != 0) toneSums_.add(still_.mean(x, y), videoAt(x, y));
    tone_ = toneSums_.curve();
}

float TrustedPairs::toneOf(float value) const {
    const float bounded = std::clamp(value, 0.0F, 255.0F);
    const int level = std::min(static_cast<int>(bounded), 254);
    return tone_[level] + (value - static_cast<float>(level)) * (tone_[level + 1] - tone_[level]);
}

/// Fits two things: a symmetric 5x5 kernel that blurs the still as much as the video (the sensors
/// have different point spread functions), and the factor Guidance::light (0 if a video pixel is
/// the mean of the grey levels that it sees, 1 if it is the root of the mean of their squares).
/// Differences between still and video that remain come from noise or from wrong matches.
void TrustedPairs::fitBlur() {
    constexpr int kReach = 2;
    Plane toned(seen_.size());
    for (int y = 0; y < video_.height; ++y)
        for (int x = 0; x < video_.width; ++x)
            toned[at(x, y)] = toneOf(still_.mean(x, y));
    const auto around = [&](int x, int y) {
        Weights sums = Weights::Zero();
        for (int dy = -kReach; dy <= kReach; ++dy)
            for (int dx = -kReach; dx <= kReach; ++dx)
                sums[weightOf(dx, dy)] += toned[at(x + dx, y + dy)] - toned[at(x, y)];
        const float mean = still_.mean(x, y);
        sums[kLight] = toneOf(mean + still_.rootAboveMean(x, y)) - toneOf(mean);
        return sums;
    };
    const auto isKnown = [&](int x, int y) {
        for (const int dy : {-kReach, kReach})
            for (const int dx : {-kReach, kReach})
                if (known_[(y + dy) / kCell][(x + dx) / kCell] == 0) return false;
        return true;
    };
    WeightSquares squares;
    squares.setIdentity();
    Weights products = Weights::Zero();
    seen_ = toned;
    for (int y = kBorder; y < video_.height - kBorder && !stop_.stop_requested(); ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            if (!isKnown(x, y)) continue;
            const Weights sums = around(x, y);
            squares.noalias() += sums * sums.transpose();
            products += sums * (videoAt(x, y) - toned[at(x, y)]);
        }
    const Weights weights = bestWeights(squares, products);
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x)
            if (isKnown(x, y)) seen_[at(x, y)] += static_cast<float>(weights.dot(around(x, y)));
}

void TrustedPairs::fitMean() {
    const auto isKnown = [&](int x, int y) { return known_[y / kCell][x / kCell] != 0; };
    const BoxSums counts(video_, [&](int x, int y) { return isKnown(x, y) ? 1.0 : 0.0; });
    const BoxSums lacks(video_, [&](int x, int y) {
        return isKnown(x, y) ? videoAt(x, y) - seen_[at(x, y)] : 0.0;
    });
    for (int y = 0; y < video_.height; ++y)
        for (int x = 0; x < video_.width; ++x) {
            const double count = counts.around(x, y, kMeanReach);
            mean_[at(x, y)] =
                static_cast<float>(count > 0 ? lacks.around(x, y, kMeanReach) / count : 0);
        }
}

/// Returns the sums from which shift() estimates the error of each cell's look-up.
std::vector<TrustedPairs::ShiftSums> TrustedPairs::shiftSums() const {
    const auto isKnown = [&](int x, int y) { return known_[y / kCell][x / kCell] != 0; };
    std::vector<ShiftSums> out(static_cast<std::size_t>(cells_.width) * cells_.height);
    for (int y = 1; y < video_.height - 1; ++y)
        for (int x = 1; x < video_.width - 1; ++x) {
            if (!isKnown(x, y) || !isKnown(x - 1, y) || !isKnown(x + 1, y) || !isKnown(x, y - 1) ||
                !isKnown(x, y + 1))
                continue;
            const double gx = double(seen_[at(x + 1, y)] - seen_[at(x - 1, y)]) / 2,
                         gy = double(seen_[at(x, y + 1)] - seen_[at(x, y - 1)]) / 2,
                         e = videoAt(x, y) - seen_[at(x, y)] - mean_[at(x, y)];
            out[static_cast<std::size_t>(y / kCell) * cells_.width + x / kCell].add(
                {gx * gx, gx * gy, gy * gy, gx * e, gy * e});
        }
    return out;
}

/// Corrects each cell's look-up by a fraction of a pixel, with one Lucas-Kanade step over 12x12
/// pixels: the cell and its eight neighbours.
void TrustedPairs::shift() {
    const std::vector<ShiftSums> sums = shiftSums();
    for (int y = 0; y < cells_.height; ++y)
        for (int x = 0; x < cells_.width; ++x) {
            if (known_[y][x] == 0) continue;
            ShiftSums s;
            for (int j = std::max(y - 1, 0); j <= std::min(y + 1, cells_.height - 1); ++j)
                for (int i = std::max(x - 1, 0); i <= std::min(x + 1, cells_.width - 1); ++i)
                    s.add(sums[static_cast<std::size_t>(j) * cells_.width + i]);
            constexpr double kDamping = 400;  // noise in s.xx and s.yy [grey levels^2 / px^2]
            const double a = s.xx + kDamping, b = s.yy + kDamping, det = a * b - s.xy * s.xy;
            const double dx = (s.xe * b - s.ye * s.xy) / det, dy = (s.ye * a - s.xe * s.xy) / det;
            lookUps_[y][x].x +=
                static_cast<float>(std::clamp(dx, -kMostShift, kMostShift) * in_.scaleX);
            lookUps_[y][x].y +=
                static_cast<float>(std::clamp(dy, -kMostShift, kMostShift) * in_.scaleY);
        }
}

void TrustedPairs::trust() {
    const auto isKnown = [&](int x, int y) { return known_[y / kCell][x / kCell] != 0; };
    const auto known = [&](const auto& valueAt) {
        return BoxSums(video_, [&](int x, int y) { return isKnown(x, y) ? valueAt(x, y) : 0.0; });
    };
    const BoxSums counts = known([](int, int) { return 1.0; });
    const BoxSums values = known([&](int x, int y) { return videoAt(x, y); });
    const BoxSums squares = known([&](int x, int y) { return videoAt(x, y) * videoAt(x, y); });
    const BoxSums errors = known([&](int x, int y) {
        const double e = videoAt(x, y) - seen_[at(x, y)] - mean_[at(x, y)];
        return e * e;
    });
    constexpr int kAll = (2 * kTrustReach + 1) * (2 * kTrustReach + 1);
    const auto mean = [&](const BoxSums& of, int x, int y) {
        return of.around(x, y, kTrustReach) / kAll;
    };
    std::vector<double> known7x7;
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            trusted_[y][x] = isKnown(x, y) && mean(counts, x, y) > 0.999;
            if (trusted_[y][x] != 0) known7x7.push_back(mean(errors, x, y));
        }
    const double noise = noiseOf(known7x7);
    int trusted = 0;
    for (int y = kBorder; y < video_.height - kBorder; ++y)
        for (int x = kBorder; x < video_.width - kBorder; ++x) {
            if (trusted_[y][x] == 0) continue;
            const double value = mean(values, x, y), variance = mean(squares, x, y) - value * value;
            trusted_[y][x] = mean(errors, x, y) <= kMostDifference * variance + noise;
            trusted += trusted_[y][x];
        }
    trustedShare_ = double(trusted) / (double(video_.width) * video_.height);
}

Phases TrustedPairs::stillOf(int x, int y) const {
    Phases out;
    for (int phase = 0; phase < kPhases; ++phase)
        out[phase] = toneOf(still_.at(x, y, phase)) + mean_[at(x, y)];
    return out;
}

Phases TrustedPairs::videoOf(int x, int y) const {
    return cubicOf(x, y, [&](int i, int j) { return videoAt(i, j); });
}

Phases TrustedPairs::target(int x, int y) const {
    return stillOf(x, y) - videoOf(x, y);
}

void TrustedPairs::measureSharpness() {
    double still = 0, cubic = 0;
    for (int y = 0; y < video_.height; ++y)
        for (int x = 0; x < video_.width; ++x) {
            if (!trusts(x, y)) continue;
            const auto varianceOf = [](const Phases& values) {
                return (values.array() - values.mean()).square().mean();
            };
            const double ofCubic = varianceOf(videoOf(x, y));
            if (ofCubic < kStructure) continue;
            cubic += ofCubic;
            still += varianceOf(stillOf(x, y));
        }
    sharpness_ = cubic > 0 ? still / cubic : 0;
}

}  // namespace mfar::enlarge
