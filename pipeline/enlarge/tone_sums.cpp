#include "pipeline/enlarge/tone_sums.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::enlarge {
namespace {

constexpr double kLeastOfRange = 100;  // ranges with fewer pixels are left out
// The sums over older stills are multiplied by this factor when a still agrees with them. A still
// that contradicts them replaces them.
constexpr double kKeptPerStill = 0.6;
// A tone curve contradicts a still if its mean error exceeds both kWrongTone [grey levels] and
// kWrongShare times the error without a tone curve. The curve in use stays as long as its mean
// error is at most kWrongTone.
constexpr double kWrongTone = 2;
constexpr double kWrongShare = 0.25;
constexpr double kMostOfRange = 1e12;

/// Inverts a tone curve: returns the grey level that the curve changes to `level`.
double levelBefore(double level, const StillTone& tone) {
    if (tone.isIdentity()) return level;
    const auto& levels = tone.levels;
    const auto first = std::ranges::lower_bound(levels, level),
               last = std::ranges::upper_bound(levels, level);
    // The tone curve maps one or more levels to `level`. Returns the middle of these levels.
    if (first != last)
        return (double(first - levels.begin()) + double(last - levels.begin()) - 1) / 2;
    if (first == levels.begin()) return 0;
    if (first == levels.end()) return StillTone::kLevels - 1;
    const double below = first[-1], above = *first;
    return double(first - levels.begin()) - 1 + (level - below) / (above - below);
}

}  // namespace

void ToneSums::add(double still, double video, double count) {
    constexpr double kPerRange = double(StillTone::kLevels) / kRanges;
    const double number = std::clamp(still / kPerRange, 0.0, kRanges - 1.0);
    Range& range = ranges_[static_cast<std::size_t>(number)];
    range.count += count;
    range.still += count * still;
    range.video += count * video;
}

void ToneSums::add(const ToneSums& others, const StillTone& tone) {
    for (const Range& range : others.ranges_)
        if (range.count > 0)
            add(levelBefore(range.still / range.count, tone), range.video / range.count,
                range.count);
}

void ToneSums::fade(double share) {
    for (Range& range : ranges_) {
        range.count *= share;
        range.still *= share;
        range.video *= share;
    }
}

ToneSums::Curve ToneSums::curve() const {
    std::vector<std::array<double, 2>> knots;
    for (const Range& range : ranges_)
        if (range.count >= kLeastOfRange)
            knots.push_back({range.still / range.count, range.video / range.count});
    Curve out{};
    for (std::size_t level = 0; level < out.size(); ++level) {
        const auto still = static_cast<double>(level);
        if (knots.size() < 2) {
            out[level] =
                static_cast<float>(knots.empty() ? still : still + knots[0][1] - knots[0][0]);
            continue;
        }
        std::size_t i = 1;
        while (i + 1 < knots.size() && still > knots[i][0])
            ++i;
        const auto [x0, y0] = knots[i - 1];
        const auto [x1, y1] = knots[i];
        out[level] = static_cast<float>(y0 + (y1 - y0) * (still - x0) / (x1 - x0));
    }
    return out;
}

StillTone ToneSums::tone() const {
    const Curve levels = curve();
    StillTone out;
    float least = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        least = std::max(least, levels[i]);
        out.levels[i] = static_cast<std::uint8_t>(std::lround(std::min(least, 255.0F)));
    }
    return out;
}

double ToneSums::distanceFrom(const StillTone& tone) const {
    double sum = 0, count = 0;
    for (const Range& range : ranges_) {
        if (range.count < kLeastOfRange) continue;
        const double still = std::clamp(range.still / range.count, 0.0, 255.0);
        const auto below = static_cast<std::size_t>(std::min(still, 254.0));
        const double shown = std::lerp(double(tone.levels[below]), double(tone.levels[below + 1]),
                                       still - double(below));
        sum += std::abs(range.video - range.count * shown);
        count += range.count;
    }
    return count > 0 ? sum / count : 0;
}

std::array<double, ToneSums::kNumbers> ToneSums::stored() const {
    std::array<double, kNumbers> out{};
    std::size_t next = 0;
    for (const Range& range : ranges_)
        for (const double value : {range.count, range.still, range.video})
            out[next++] = value;
    return out;
}

bool ToneSums::restore(const std::array<double, kNumbers>& numbers) {
    std::array<Range, kRanges> ranges;
    std::size_t next = 0;
    for (Range& range : ranges) {
        range = {numbers[next], numbers[next + 1], numbers[next + 2]};
        next += 3;
        const double most = 256 * range.count;
        if (!(range.count >= 0 && range.count <= kMostOfRange)) return false;
        if (!(range.still >= -most && range.still <= most)) return false;
        if (!(range.video >= -most && range.video <= most)) return false;
    }
    ranges_ = ranges;
    return true;
}

void ToneLearner::add(const ToneSums& seen, const StillTone& applied) {
    ToneSums newest;
    newest.add(seen, applied);
    const double allowed = std::max(kWrongTone, kWrongShare * newest.distanceFrom({}));
    const bool agrees = newest.distanceFrom(sums_.tone()) <= allowed;
    sums_.fade(agrees ? kKeptPerStill : 0);
    sums_.add(newest, {});
    if (newest.distanceFrom(tone_) > kWrongTone) tone_ = agrees ? sums_.tone() : StillTone{};
}

std::array<double, ToneLearner::kNumbers> ToneLearner::stored() const {
    std::array<double, kNumbers> out{};
    std::ranges::copy(sums_.stored(), out.begin());
    out.back() = tone_.isIdentity() ? 0 : 1;
    return out;
}

bool ToneLearner::restore(const std::array<double, kNumbers>& numbers) {
    std::array<double, ToneSums::kNumbers> sums{};
    std::ranges::copy_n(numbers.begin(), sums.size(), sums.begin());
    const double inUse = numbers.back();
    if (!(inUse == 0 || inUse == 1) || !sums_.restore(sums)) return false;
    tone_ = inUse == 1 ? sums_.tone() : StillTone{};
    return true;
}

}  // namespace mfar::enlarge
