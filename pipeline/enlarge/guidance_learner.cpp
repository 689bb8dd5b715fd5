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

// When a new pair of stills arrives, the sums over all older pairs are multiplied by this factor.
constexpr double kForgetting = 0.95;
// The prior of the least-squares fit is zero guidance. It counts as much as this number of pixels.
constexpr double kPriorPixels = 2000;
// Guidance is learned only from at least this number of pixels, as a share of the frame's pixels.
constexpr double kLeastPixels = 0.02;
// Guidance is used only if it reduces the squared error by more than this share.
constexpr double kWorthwhile = 0.005;
// If all new factors differ from the factors in use by at most this, they are ignored, because they
// would change the pictures without improving them.
constexpr float kSame = 0.01F;
// The fit alternates between the light and the other factors this number of times.
constexpr int kRounds = 12;
// The factors of still and video cannot be determined separately if the determinant of the normal
// equations, divided by the product of their diagonal, is below this.
constexpr double kLeastDeterminant = 1e-9;
constexpr double kMostPairs = 1e15;  // a double represents counts below this exactly
// Pixels with a video luma outside these limits may be saturated [1/8 grey level].
constexpr int kDarkest = 2 * kLumaScale, kBrightest = 253 * kLumaScale;

/// Recomputes what was added to the cubic enlargement of a frame, at the output positions of one
/// video pixel: the terms that guidance scales, and the rest.
class DrawnFrame {
public:
    DrawnFrame(const MatchedPictures& pictures, const FilterBank& filters,
               const std::stop_token& stop)
        : in_(pictures), filters_(filters), known_(pictures.lookUps.size()),
          cells_(pictures.lookUps.size()), still_(pictures.video),
          stillFine_(static_cast<std::size_t>(pictures.video.width) * pictures.video.height),
          videoFine_(stillFine_.size()), light_(stillFine_.size()), lightFine_(stillFine_.size()),
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

    [[nodiscard]] bool knows(int x, int y) const {
        for (const int dy : {-2, 2})
            for (const int dx : {-2, 2})
                if (!isKnown(x + dx, y + dy)) return false;
        return true;
    }
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
    struct Added {
        Phases unguided;  ///< addition to the cubic enlargement without guidance
        FactorSums::Parts parts;
    };
    void addedTo(int x, int y, Added& out) const {
        const Phases low = cubicOf(x, y, [&](int i, int j) { return still_.mean(i, j); });
        const Phases weights = weightsAt(cells_, x, y);
        const auto enlarged = [&](const std::vector<float>& values) {
            return cubicOf(x, y, [&](int i, int j) { return values[at(i, j)]; });
        };
        out.parts << enlarged(stillFine_), -enlarged(videoFine_), -enlarged(light_),
            enlarged(lightFine_);
        for (int phase = 0; phase < kPhases; ++phase) {
            const int row = phase / kGrid, column = kGrid * x + phase % kGrid;
            const double residual = double(residual_[row][column]) / kResidualScale;
            const double detail = still_.at(x, y, phase) - low[phase], weight = weights[phase];
            out.unguided[phase] = weight * detail + (1 - std::min(weight, 1.0)) * residual;
            out.parts.row(phase) *= weight;
        }
    }

private:
    [[nodiscard]] bool isKnown(int x, int y) const { return known_[y / kCell][x / kCell] != 0; }
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * in_.video.width + x;
    }
    /// Subtracts from each value the mean over the known pixels around it, see params::kGuideReach.
    /// Stores the results in `out`.
    template <class Value>
    void beyondMean(const BoxSums& counts, std::vector<float>& out, const Value& value) const {
        const BoxSums sums(in_.video,
                           [&](int x, int y) { return isKnown(x, y) ? value(x, y) : 0.0; });
        for (int y = 0; y < in_.video.height; ++y)
            for (int x = 0; x < in_.video.width; ++x) {
                if (!isKnown(x, y)) continue;
                const double mean = sums.around(x, y, params::kGuideReach) /
                                    counts.around(x, y, params::kGuideReach);
                out[at(x, y)] = static_cast<float>(value(x, y) - mean);
            }
    }
    void compare() {
        const BoxSums counts(in_.video, [&](int x, int y) { return isKnown(x, y) ? 1.0 : 0.0; });
        for (int y = 0; y < in_.video.height; ++y)
            for (int x = 0; x < in_.video.width; ++x)
                if (isKnown(x, y)) light_[at(x, y)] = still_.rootAboveMean(x, y);
        beyondMean(counts, stillFine_, [&](int x, int y) { return double(still_.mean(x, y)); });
        beyondMean(counts, lightFine_, [&](int x, int y) { return double(light_[at(x, y)]); });
        beyondMean(counts, videoFine_,
                   [&](int x, int y) { return in_.row(y)[x] / double(kLumaScale); });
    }

    const MatchedPictures& in_;
    const FilterBank& filters_;
    AlignedRows<std::uint8_t> known_;
    AlignedRows<LookUpCell> cells_;
    WarpedGrid still_;
    std::vector<float> stillFine_, videoFine_, light_, lightFine_;
    AlignedRows<float> sums_;
    AlignedRows<std::uint16_t> classes_;
    AlignedRows<std::int16_t> range_, residual_;
};

bool isSaturated(const MatchedPictures& pictures, int x, int y) {
    const int luma = pictures.row(y)[x];
    return luma < kDarkest || luma > kBrightest;
}

}  // namespace

void FactorSums::add(const Parts& parts, const Phases& missing) {
    products_.noalias() += parts.transpose() * parts;
    withMissing_.noalias() += parts.transpose() * missing;
    missing2_ += missing.squaredNorm();
    pixels_ += 1;
}

void FactorSums::add(const FactorSums& other) {
    products_ += other.products_;
    withMissing_ += other.withMissing_;
    missing2_ += other.missing2_;
    pixels_ += other.pixels_;
}

void FactorSums::fade(double share) {
    products_ *= share;
    withMissing_ *= share;
    missing2_ *= share;
    pixels_ *= share;
}

bool FactorSums::isFinite() const {
    // The product of two values is at most the larger of their squares. So if the sums of squares
    // are finite, all sums are.
    return std::isfinite(products_.trace() + missing2_);
}

double FactorSums::gainOf(const Guidance& of) const {
    const Weights weights{of.still, of.video, of.light, double(of.light) * of.still};
    return 2 * weights.dot(withMissing_) - weights.dot(products_ * weights);
}

/// Returns the best guidance with the given light.
Guidance FactorSums::withLight(double light, double prior) const {
    Weights byStill = Weights::Unit(Still), byVideo = Weights::Unit(Video);
    byStill[LightOfStill] = light;
    const Weights left = withMissing_ - products_.col(Light) * light;
    const double still2 = byStill.dot(products_ * byStill), video2 = products_(Video, Video);
    const double stillVideo = byStill.dot(products_ * byVideo);
    const double stillMissing = byStill.dot(left), videoMissing = byVideo.dot(left);
    Guidance out{0, 0, static_cast<float>(light)};
    if (!(still2 > 0 && video2 > 0)) return out;
    const double apart = std::max(still2 - stillVideo * stillVideo / video2, 0.0);
    const double pull = apart * prior / pixels_;
    const double a2 = still2 + pull, b2 = video2 + pull;
    const double determinant = a2 * b2 - stillVideo * stillVideo;
    if (!(determinant > kLeastDeterminant * a2 * b2)) return out;
    const auto stillFor = [&](double video) { return (stillMissing - video * stillVideo) / a2; };
    const auto videoFor = [&](double still) { return (videoMissing - still * stillVideo) / b2; };
    // `free` is the best factor of the still if both factors could have any value. If it is out of
    // range, the best point on the border of the range is used.
    const double free = (stillMissing * b2 - videoMissing * stillVideo) / determinant;
    const double still = std::clamp(free, 0.0, 1.0);
    const double video = std::clamp(videoFor(still), 0.0, double(Guidance::kMost));
    out.still = static_cast<float>(std::clamp(stillFor(video), 0.0, 1.0));
    out.video = static_cast<float>(video);
    return out;
}

/// Returns the best light with the other factors of `of`.
double FactorSums::lightFor(const Guidance& of, double prior) const {
    Weights byLight = Weights::Unit(Light), others = Weights::Zero();
    byLight[LightOfStill] = of.still;
    others[Still] = of.still;
    others[Video] = of.video;
    const double square = byLight.dot(products_ * byLight) * (1 + prior / pixels_);
    if (!(square > 0)) return 0;
    return std::clamp(byLight.dot(withMissing_ - products_ * others) / square, 0.0,
                      double(Guidance::kMost));
}

Guidance FactorSums::best(double prior, bool fitsLight) const {
    if (!(pixels_ > 0)) return {};
    Guidance out = withLight(0, prior);
    for (int round = 0; fitsLight && round < kRounds; ++round)
        out = withLight(lightFor(out, prior), prior);
    return out;
}

std::array<double, FactorSums::kNumbers> FactorSums::stored() const {
    const auto& p = products_;
    const Weights& m = withMissing_;
    return {p(Still, Still),
            p(Video, Video),
            missing2_,
            p(Still, Video),
            m[Still],
            m[Video],
            pixels_,
            p(Light, Light),
            p(LightOfStill, LightOfStill),
            p(Still, Light),
            p(Still, LightOfStill),
            p(Video, Light),
            p(Video, LightOfStill),
            p(Light, LightOfStill),
            m[Light],
            m[LightOfStill]};
}

bool FactorSums::restore(const std::array<double, kNumbers>& of) {
    constexpr std::array kSquares{0, 1, 2, 6, 7, 8};
    if (!std::ranges::all_of(kSquares, [&](int i) { return of[i] >= 0; })) return false;
    products_ << of[0], of[3], of[9], of[10],  //
        of[3], of[1], of[11], of[12],          //
        of[9], of[11], of[7], of[13],          //
        of[10], of[12], of[13], of[8];
    withMissing_ << of[4], of[5], of[14], of[15];
    missing2_ = of[2];
    pixels_ = of[6];
    return true;
}

bool GuidanceLearner::add(const TrustedPairs& truth, const MatchedPictures& older,
                          const FilterBank& filters, const std::stop_token& stop) {
    const auto [width, height] = truth.size();
    if (older.video != truth.size()) return false;
    DrawnFrame frame(older, filters, stop);
    FactorSums learn, held;
    DrawnFrame::Added added;
    for (int y = 0; y < height && !stop.stop_requested(); ++y) {
        frame.begin(y);
        for (int x = 0; x < width; ++x) {
            if (!truth.trusts(x, y) || !frame.knows(x, y) || isSaturated(older, x, y)) continue;
            frame.addedTo(x, y, added);
            const Phases missing = truth.target(x, y) - added.unguided;
            // One third of the tiles is held out. Guidance is learned from the other tiles, and its
            // gain is measured in the held-out tiles.
            FactorSums& to = (x / kTileSize + y / kTileSize) % 3 == 0 ? held : learn;
            to.add(added.parts, missing);
        }
    }
    if (stop.stop_requested() || !learn.isFinite() || !held.isFinite()) return false;
    if (!(learn.pixels() >= kLeastPixels * width * height && held.pixels() > 0)) return false;
    ++pairs_;
    learned_.fade(kForgetting);
    learned_.add(learn);
    held_.fade(kForgetting);
    held_.add(held);
    const double worthwhile = kWorthwhile * held_.missing2();
    const auto helps = [&](const Guidance& of) {
        return held_.gainOf(of) > worthwhile && held.gainOf(of) > 0;
    };
    Guidance candidate = learned_.best(kPriorPixels, false);
    const Guidance withLight = learned_.best(kPriorPixels, true);
    if (helps(withLight) && held_.gainOf(withLight) > held_.gainOf(candidate) + worthwhile)
        candidate = withLight;
    if (!helps(candidate))
        guidance_ = helps(guidance_) ? guidance_ : Guidance{};
    else if (std::abs(candidate.still - guidance_.still) > kSame ||
             std::abs(candidate.video - guidance_.video) > kSame ||
             std::abs(candidate.light - guidance_.light) > kSame)
        guidance_ = candidate;
    return true;
}

double GuidanceLearner::gainDb() const {
    const double left = held_.missing2() - held_.gainOf(guidance_);
    return left > 0 ? 10 * std::log10(held_.missing2() / left) : 0;
}

std::array<double, GuidanceLearner::kNumbers> GuidanceLearner::stored() const {
    std::array<double, kNumbers> out{static_cast<double>(pairs_), guidance_.still, guidance_.video};
    const auto learned = learned_.stored(), held = held_.stored();
    constexpr auto kOld = FactorSums::kOldNumbers;
    auto to = std::copy_n(learned.begin(), kOld, out.begin() + 3);
    to = std::copy_n(held.begin(), kOld, to);
    *to++ = guidance_.light;
    to = std::copy(learned.begin() + kOld, learned.end(), to);
    std::copy(held.begin() + kOld, held.end(), to);
    return out;
}

bool GuidanceLearner::restore(const std::array<double, kNumbers>& numbers) {
    constexpr auto kOld = FactorSums::kOldNumbers, kNew = FactorSums::kNumbers - kOld;
    const Guidance guidance{static_cast<float>(numbers[1]), static_cast<float>(numbers[2]),
                            static_cast<float>(numbers[kOldNumbers])};
    if (!(numbers[0] >= 0 && numbers[0] < kMostPairs) || !guidance.isValid()) return false;
    const auto sums = [&](std::size_t i, FactorSums& out) {
        std::array<double, FactorSums::kNumbers> of{};
        const auto to = std::copy_n(numbers.begin() + 3 + i * kOld, kOld, of.begin());
        std::copy_n(numbers.begin() + kOldNumbers + 1 + i * kNew, kNew, to);
        return out.restore(of);
    };
    FactorSums learned, held;
    if (!sums(0, learned) || !sums(1, held)) return false;
    pairs_ = static_cast<std::uint64_t>(numbers[0]);
    guidance_ = guidance;
    learned_ = learned;
    held_ = held;
    return true;
}

}  // namespace mfar::enlarge
