#include "pipeline/enlarge/guidance_learner.h"

#include "pipeline/engine/params/detail.h"
#include "pipeline/enlarge/box_sums.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/plan/tiles.h"
#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::enlarge {
namespace {

constexpr double kForgetting = 0.95;  // as of filters
// No guidance counts like this many pixels.
constexpr double kPriorPixels = 2000;
constexpr double kLeastPixels = 0.02;  // of the picture, in the parts that are learned from
// The guidance is used for at least this share of the error.
constexpr double kWorthwhile = 0.005;
// A new guidance replaces one that is as near as this never: pictures would change for nothing.
constexpr float kSame = 0.01F;
// Levels between which neither sensor is saturated [1/8 grey level].
constexpr int kDarkest = 2 * kLumaScale, kBrightest = 253 * kLumaScale;

/// What a frame is drawn of, at the sub-pixels of one pixel after the other.
class DrawnFrame {
public:
    DrawnFrame(const MatchedPictures& pictures, const FilterBank& filters,
               const std::stop_token& stop)
        : in_(pictures), filters_(filters), known_(pictures.lookUps.size()),
          cells_(pictures.lookUps.size()), still_(pictures.video),
          guide_(static_cast<std::size_t>(pictures.video.width) * pictures.video.height),
          sums_({pictures.video.width + 2 * MatchedPictures::kMargin, 3}),
          classes_({pictures.video.width, 2}), range_({pictures.video.width, 2}),
          residual_({kGrid * pictures.video.width, kGrid}) {
        for (int y = 0; y < cells_.size().height; ++y)
            for (int x = 0; x < cells_.size().width; ++x) {
                LookUpCell cell = in_.lookUps[y][x];
                known_[y][x] = std::isfinite(cell.x) && std::isfinite(cell.y) &&
                               std::isfinite(cell.weight) && cell.weight > 0;
                if (known_[y][x] == 0) cell = {};
                cells_[y][x] = cell;
            }
        still_.warp(in_, cells_, known_, stop);
        compare();
    }

    /// Is all known that the pixel's detail is made of?
    [[nodiscard]] bool knows(int x, int y) const {
        for (const int dy : {-2, 2})
            for (const int dx : {-2, 2})
                if (!isKnown(x + dx, y + dy)) return false;
        return true;
    }
    /// The row of the next pixels.
    void begin(int y) {
        std::array<const std::int16_t*, 7> rows{};
        for (int k = 0; k < 7; ++k)
            rows[k] = in_.row(y + k - 3);
        const int width = in_.video.width;
        const auto sums = [&](int i) { return sums_[i] + MatchedPictures::kMargin; };
        simd::classRow(rows, 0, width, {sums(0), sums(1), sums(2)}, classes_[0], classes_[1]);
        const std::array<const std::int16_t*, 5> inner{rows[1], rows[2], rows[3], rows[4], rows[5]};
        simd::rangeRow(inner, 0, width, range_[0], range_[1]);
        const Rows<const std::int16_t> gradient = filters_.gradient(),
                                       curvature = filters_.curvature();
        simd::residualRows(
            {inner, classes_[0], classes_[1], range_[0], range_[1]},
            {gradient.data, curvature.data, filters_.cubic(), gradient.pitch, curvature.pitch}, 0,
            width, {residual_[0], residual_[1], residual_[2], residual_[3]});
    }
    /// What is added to the cubic without guidance, and what full guidance adds to that.
    void addedTo(int x, int y, Phases& added, Phases& guided) const {
        const Phases low = cubicOf(x, y, [&](int i, int j) { return still_.mean(i, j); });
        const Phases weights = betweenCells(cells_, &LookUpCell::weight, x, y);
        guided = cubicOf(x, y, [&](int i, int j) { return guide_[at(i, j)]; });
        for (int phase = 0; phase < kPhases; ++phase) {
            const int row = phase / kGrid, column = kGrid * x + phase % kGrid;
            const double residual = double(residual_[row][column]) / kResidualScale;
            const double detail = still_.at(x, y, phase) - low[phase], weight = weights[phase];
            added[phase] = weight * detail + (1 - std::min(weight, 1.0)) * residual;
            guided[phase] *= weight;
        }
    }

private:
    [[nodiscard]] bool isKnown(int x, int y) const { return known_[y / kCell][x / kCell] != 0; }
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * in_.video.width + x;
    }
    /// See params::kGuideReach.
    void compare() {
        const auto difference = [&](int x, int y) {
            if (!isKnown(x, y)) return 0.0;
            return still_.mean(x, y) - in_.row(y)[x] / double(kLumaScale);
        };
        const BoxSums counts(in_.video, [&](int x, int y) { return isKnown(x, y) ? 1.0 : 0.0; });
        const BoxSums sums(in_.video, difference);
        for (int y = 0; y < in_.video.height; ++y)
            for (int x = 0; x < in_.video.width; ++x) {
                if (!isKnown(x, y)) continue;
                const double mean = sums.around(x, y, params::kGuideReach) /
                                    counts.around(x, y, params::kGuideReach);
                guide_[at(x, y)] = static_cast<float>(difference(x, y) - mean);
            }
    }

    const MatchedPictures& in_;
    const FilterBank& filters_;
    AlignedRows<std::uint8_t> known_;
    AlignedRows<LookUpCell> cells_;
    WarpedGrid still_;
    std::vector<float> guide_;
    AlignedRows<float> sums_;
    AlignedRows<std::uint16_t> classes_;
    AlignedRows<std::int16_t> range_, residual_;
};

bool isSaturated(const MatchedPictures& pictures, int x, int y) {
    const int luma = pictures.row(y)[x];
    return luma < kDarkest || luma > kBrightest;
}

}  // namespace

void FactorSums::add(const FactorSums& other) {
    added += other.added;
    product += other.product;
    missing += other.missing;
    pixels += other.pixels;
}

void FactorSums::fade(double share) {
    for (double* sum : {&added, &product, &missing, &pixels})
        *sum *= share;
}

bool GuidanceLearner::add(const TrustedPairs& truth, const MatchedPictures& older,
                          const FilterBank& filters, const std::stop_token& stop) {
    const auto [width, height] = truth.size();
    if (older.video != truth.size()) return false;
    DrawnFrame frame(older, filters, stop);
    FactorSums learn, held;
    Phases added, guided;
    for (int y = 0; y < height && !stop.stop_requested(); ++y) {
        frame.begin(y);
        for (int x = 0; x < width; ++x) {
            if (!truth.trusts(x, y) || !frame.knows(x, y) || isSaturated(older, x, y)) continue;
            frame.addedTo(x, y, added, guided);
            const Phases missing = truth.target(x, y) - added;
            // Every third tile is held out, by place as for filters.
            FactorSums& to = (x / kTileSize + y / kTileSize) % 3 == 0 ? held : learn;
            to.add({guided.squaredNorm(), guided.dot(missing), missing.squaredNorm(), 1});
        }
    }
    const double sum = learn.added + learn.product + learn.missing + held.added + held.missing;
    if (stop.stop_requested() || !std::isfinite(sum)) return false;
    if (!(learn.pixels >= kLeastPixels * width * height && held.pixels > 0)) return false;
    ++pairs_;
    learned_.fade(kForgetting);
    learned_.add(learn);
    held_.fade(kForgetting);
    held_.add(held);
    const double pull = learned_.added * kPriorPixels / learned_.pixels;
    const double best = learned_.added > 0 ? learned_.product / (learned_.added + pull) : 0;
    const auto candidate = static_cast<float>(std::clamp(best, 0.0, 1.0));
    const auto helps = [&](float factor) {
        return held_.gainOf(factor) > kWorthwhile * held_.missing && held.gainOf(factor) > 0;
    };
    if (!helps(candidate))
        guidance_ = helps(guidance_) ? guidance_ : 0;
    else if (std::abs(candidate - guidance_) > kSame)
        guidance_ = candidate;
    return true;
}

double GuidanceLearner::gainDb() const {
    const double left = held_.missing - held_.gainOf(guidance_);
    return left > 0 ? 10 * std::log10(held_.missing / left) : 0;
}

std::array<double, GuidanceLearner::kNumbers> GuidanceLearner::stored() const {
    return {static_cast<double>(pairs_),
            guidance_,
            learned_.added,
            learned_.product,
            learned_.missing,
            learned_.pixels,
            held_.added,
            held_.product,
            held_.missing,
            held_.pixels};
}

bool GuidanceLearner::restore(const std::array<double, kNumbers>& numbers) {
    const auto sums = [&](std::size_t i) {
        return FactorSums{numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]};
    };
    const auto sound = [](const FactorSums& of) {
        return of.added >= 0 && of.missing >= 0 && of.pixels >= 0;
    };
    if (!(numbers[0] >= 0 && numbers[0] < 1e15 && numbers[1] >= 0 && numbers[1] <= 1)) return false;
    if (!sound(sums(2)) || !sound(sums(6))) return false;
    pairs_ = static_cast<std::uint64_t>(numbers[0]);
    guidance_ = static_cast<float>(numbers[1]);
    learned_ = sums(2);
    held_ = sums(6);
    return true;
}

}  // namespace mfar::enlarge
