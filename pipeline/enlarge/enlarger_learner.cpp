#include "pipeline/enlarge/enlarger_learner.h"

#include "pipeline/enlarge/prior_filters.h"
#include "pipeline/plan/tiles.h"
#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace mfar {
namespace {

using namespace enlarge;

// A class needs at least this number of pixels in each Part of the tiles. With fewer in Part::Learn
// or Part::Choose, the class gets no learned filter. With fewer in Part::Check, the class's filter
// is checked only together with the filters of all other classes.
constexpr double kLeastPixels = 400;
// Before the sums of a new still are added, the sums over all older stills are multiplied by this
// factor.
constexpr double kForgetting = 0.95;
// In the least-squares fit, the shipped filter counts as much as this number of pixels.
constexpr double kPriorPixels = 300;
constexpr double kRidge = 20;  // added to the diagonal of the normal equations [grey levels^2]
// Stills with a smaller share of trusted pixels are not learned from, because matching has failed.
constexpr double kLeastTrusted = 0.05;
// Stills whose TrustedPairs::sharpness() is below this are not learned from, because they are
// hardly sharper than the video.
constexpr double kLeastSharpness = 1.03;
// A tile has changed if the mean of one of its 4x4-pixel blocks changed by more than this [grey
// levels].
constexpr int kNewFrom = 4;
constexpr double kLeastNew = 0.1;  // least share of changed tiles in a still that is learned from
// A learned filter is selected if its error is less than kWorthwhile times the error of the shipped
// filter or of the zero filter, whichever is better.
constexpr double kWorthwhile = 0.998;

// The tone curve is dropped when this number of stills that used it were refused because of
// kLeastTrusted or kLeastSharpness, without a better still between them.
constexpr int kMostRefused = 3;
constexpr int kBlock = 4;  // block size [px]

Size blocksOf(Size video) {
    const Size tiles = tilesOf(video);
    return {tiles.width * kTileSize / kBlock, tiles.height * kTileSize / kBlock};
}

std::size_t tileOfBlock(int x, int y, Size tiles) {
    return static_cast<std::size_t>(y * kBlock / kTileSize) * tiles.width + x * kBlock / kTileSize;
}

}  // namespace

EnlargerLearner::EnlargerLearner() : learned_(kUnique, false) {
    for (const FilterBank::Filter& filter : readFilters(priorFilters(), "built-in filters"))
        prior_.push_back(weightsOf(filter));
    putInPlace(prior_, learned_);
}

/// Returns the part to which the tile at this position belongs. The part is the same in all
/// pictures. If it changed, a camera at rest would check filters on pixels from which they were
/// learned.
EnlargerLearner::Part EnlargerLearner::partOf(int column, int row) {
    const int number = (column + 2 * row) % 5;
    return number == 0 ? Part::Check : number == 2 ? Part::Choose : Part::Learn;
}

EnlargerLearner::Outcome EnlargerLearner::add(const MatchedPictures& pictures,
                                              const std::stop_token& stop) {
    if (!findNew(pictures)) {
        ++counts_.repeated;
        return Outcome::Repeated;
    }
    const TrustedPairs pairs(pictures, stop);
    if (stop.stop_requested()) return Outcome::Stopped;
    if (!(pairs.trustedShare() >= kLeastTrusted && pairs.sharpness() >= kLeastSharpness)) {
        ++counts_.refused;
        return refusedWith(pictures.tone);
    }
    refusedInARow_ = 0;
    const StillSums still = sumsOf(pictures, pairs, stop);
    if (stop.stop_requested()) return Outcome::Stopped;
    if (isOutlier(still)) {
        ++counts_.refused;
        return Outcome::Refused;
    }
    // Once fineMatch_ has learned from the still, everything else must learn from it, too, even if
    // `stop` is requested meanwhile.
    if (!fineMatch_.add(pictures, stop) && stop.stop_requested()) return Outcome::Stopped;
    learnTone(pairs, pictures.tone);
    ++counts_.stills;
    rememberShown(pictures.video);
    sums_.fade(kForgetting);
    sums_.add(still.learn);
    held_.fade(kForgetting);
    held_.add(still.choose);
    const bool replaced = choose(still.check) || putMatchInPlace();
    held_.add(still.check);
    measure();
    return replaced ? Outcome::Replaced : Outcome::Kept;
}

// A wrong tone curve can prevent all matches. As nothing is learned without matches, the curve
// would then never be corrected. So it is dropped after several refused stills.
EnlargerLearner::Outcome EnlargerLearner::refusedWith(const StillTone& tone) {
    if (tone.isIdentity() || ++refusedInARow_ < kMostRefused) return Outcome::Refused;
    refusedInARow_ = 0;
    tone_ = {};
    return putMatchInPlace() ? Outcome::Replaced : Outcome::Refused;
}

EnlargerLearner::Outcome EnlargerLearner::addOlder(const MatchedPictures& truth,
                                                   MatchedPictures& older,
                                                   const std::stop_token& stop) {
    if (older.tone.isIdentity()) older.apply(tone_.tone());
    if (!older.tone.isNear(tone_.tone())) return Outcome::Refused;
    const TrustedPairs pairs(truth, stop);
    if (stop.stop_requested()) return Outcome::Stopped;
    if (!(pairs.trustedShare() >= kLeastTrusted && pairs.sharpness() >= kLeastSharpness))
        return Outcome::Refused;
    const bool learned = guidance_.add(pairs, older, *inPlace_, stop);
    if (stop.stop_requested()) return Outcome::Stopped;
    if (!learned) return Outcome::Refused;
    const bool changes = guidance_.guidance() != inPlace_->guidance();
    if (changes) putInPlace(current_, learned_);
    measure();
    return changes ? Outcome::Replaced : Outcome::Kept;
}

// Learns the tone curve. If the new curve is not near the old one, guidance is forgotten, because
// guidance that was learned with another tone curve adds and removes wrong shares of detail.
void EnlargerLearner::learnTone(const TrustedPairs& pairs, const StillTone& applied) {
    const StillTone before = tone_.tone();
    tone_.add(pairs.toneSums(), applied);
    if (!before.isNear(tone_.tone())) guidance_ = {};
}

bool EnlargerLearner::findNew(const MatchedPictures& pictures) {
    const Size tiles = tilesOf(pictures.video), blocks = blocksOf(pictures.video);
    const bool isFirst = blocks != shownSize_;
    means_.resize(static_cast<std::size_t>(blocks.width) * blocks.height);
    isNew_.assign(static_cast<std::size_t>(tiles.width) * tiles.height, isFirst);
    for (int y = 0; y < blocks.height; ++y)
        for (int x = 0; x < blocks.width; ++x) {
            int sum = 0;
            for (int k = 0; k < kBlock * kBlock; ++k) {
                const int column = std::min(kBlock * x + k % kBlock, pictures.video.width - 1);
                sum += pictures.row(kBlock * y + k / kBlock)[column];
            }
            const std::size_t i = static_cast<std::size_t>(y) * blocks.width + x;
            means_[i] = static_cast<std::uint8_t>(sum / (kBlock * kBlock * kLumaScale));
            if (!isFirst && std::abs(means_[i] - shown_[i]) > kNewFrom)
                isNew_[tileOfBlock(x, y, tiles)] = 1;
        }
    const auto count = std::count(isNew_.begin(), isNew_.end(), 1);
    return double(count) >= kLeastNew * double(isNew_.size());
}

void EnlargerLearner::rememberShown(Size video) {
    const Size tiles = tilesOf(video);
    // If the size is another one, all tiles are new, and all of shown_ is replaced.
    shownSize_ = blocksOf(video);
    shown_.resize(means_.size());
    for (int y = 0; y < shownSize_.height; ++y)
        for (int x = 0; x < shownSize_.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * shownSize_.width + x;
            if (isNew_[tileOfBlock(x, y, tiles)] != 0) shown_[i] = means_[i];
        }
}

EnlargerLearner::StillSums EnlargerLearner::sumsOf(const MatchedPictures& pictures,
                                                   const TrustedPairs& pairs,
                                                   const std::stop_token& stop) const {
    StillSums out;
    const auto [width, height] = pairs.size();
    const int columns = tilesOf(pairs.size()).width;
    AlignedRows<float> sums({width + 2 * MatchedPictures::kMargin, 3});
    AlignedRows<std::uint16_t> numbers({width, 2});
    const auto scratch = [&](int i) { return sums[i] + MatchedPictures::kMargin; };
    for (int y = 0; y < height && !stop.stop_requested(); ++y) {
        std::array<const std::int16_t*, 7> rows{};
        for (int k = 0; k < 7; ++k)
            rows[k] = pictures.row(y + k - 3);
        simd::classRow(rows, 0, width, {scratch(0), scratch(1), scratch(2)}, numbers[0],
                       numbers[1]);
        for (int x = 0; x < width; ++x) {
            const int column = x / kTileSize, row = y / kTileSize;
            if (!pairs.trusts(x, y)) continue;
            if (isNew_[static_cast<std::size_t>(row) * columns + column] == 0) continue;
            Taps steps;
            for (int i = 0; i < kTaps; ++i) {
                const Offset of = kTapAt[i];
                steps[i] = double(rows[3 + of.y][x + of.x] - rows[3][x]) / kLumaScale;
            }
            const Phases target = pairs.target(x, y);
            const Part part = partOf(column, row);
            SumsOfClasses& to = part == Part::Learn    ? out.learn
                                : part == Part::Choose ? out.choose
                                                       : out.check;
            to.add(uniqueByGradient(numbers[0][x]), steps, target);
            to.add(uniqueByCurvature(numbers[1][x]), steps, target);
        }
    }
    return out;
}

bool EnlargerLearner::isOutlier(const StillSums& still) {
    double cubic = 0, inPlace = 0;
    for (const SumsOfClasses* part : {&still.learn, &still.choose, &still.check})
        for (int i = 0; i < kUnique; ++i) {
            const ClassSums sums = (*part)[i].turnedToo();
            cubic += sums.squares;
            inPlace += sums.errorOf(current_[static_cast<std::size_t>(i)]);
        }
    const bool contradicts = counts_.stills > 0 && inPlace > cubic;
    const bool didBefore = std::exchange(contradicted_, contradicts);
    return contradicts && !didBefore;
}

ClassWeights EnlargerLearner::solved(int unique) const {
    const ClassSums sums = sums_[unique].turnedToo();
    const ClassWeights& prior = prior_[static_cast<std::size_t>(unique)];
    const Taps pull =
        (sums.taps.diagonal().array() * (kPriorPixels / sums_[unique].pixels) + kRidge).matrix();
    auto taps = sums.taps;
    taps.diagonal() += pull;
    const ClassWeights products = sums.products + pull.asDiagonal() * prior;
    return taps.llt().solve(products);
}

bool EnlargerLearner::choose(const SumsOfClasses& check) {
    std::vector<ClassWeights> weights = prior_;
    std::vector<bool> learned(kUnique, false);
    Errors all;
    for (int i = 0; i < kUnique; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const ClassSums held = held_[i].turnedToo(), fresh = check[i].turnedToo();
        const bool decides = held_[i].pixels >= kLeastPixels;
        if (decides && held.errorOf(prior_[n]) > held.squares) weights[n].setZero();
        if (decides && sums_[i].pixels >= kLeastPixels) {
            const ClassWeights candidate = weightsOf(roundedFilter(solved(i)));
            if (held.errorOf(candidate) < kWorthwhile * held.errorOf(weights[n])) {
                weights[n] = candidate;
                learned[n] = true;
            }
        }
        if (check[i].pixels >= kLeastPixels && fresh.errorOf(weights[n]) > fresh.squares) {
            weights[n].setZero();
            learned[n] = false;
        }
        all.candidate += fresh.errorOf(weights[n]);
        all.inPlace += fresh.errorOf(current_[n]);
        all.cubic += fresh.squares;
    }
    if (!(all.candidate < all.inPlace)) return false;
    return putInPlace(weights, learned);
}

bool EnlargerLearner::putMatchInPlace() {
    const bool isSame =
        fineMatch_.fineMatch() == inPlace_->fineMatch() && tone_.tone() == inPlace_->tone();
    return !isSame && putInPlace(current_, learned_);
}

bool EnlargerLearner::putInPlace(const std::vector<ClassWeights>& weights,
                                 const std::vector<bool>& learned) {
    std::vector<FilterBank::Filter> filters;
    for (const ClassWeights& of : weights)
        filters.push_back(roundedFilter(of));
    try {
        inPlace_ = std::make_shared<const FilterBank>(filters, guidance_.guidance(),
                                                      fineMatch_.fineMatch(), tone_.tone());
    } catch (const FilterBankError&) {
        return false;  // the weights are too large for the SIMD code
    }
    current_ = weights;
    learned_ = learned;
    counts_.classes = static_cast<int>(std::count(learned.begin(), learned.end(), true));
    return true;
}

void EnlargerLearner::measure() {
    Errors all;
    for (int i = 0; i < kUnique; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const ClassSums held = held_[i].turnedToo();
        all.cubic += held.squares;
        all.inPlace += held.errorOf(current_[n]);
        all.prior += held.errorOf(prior_[n]);
    }
    const auto gain = [&](double error) {
        return all.cubic > 0 && error > 0 ? 10 * std::log10(all.cubic / error) : 0;
    };
    counts_.gainDb = gain(all.inPlace);
    counts_.priorDb = gain(all.prior);
    counts_.pairs = guidance_.pairs();
    counts_.guidance = guidance_.guidance();
    counts_.guidanceGainDb = guidance_.gainDb();
    counts_.fineMatch = inPlace_->fineMatch();
}

}  // namespace mfar
