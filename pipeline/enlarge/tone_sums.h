#pragma once

#include "pipeline/enlarge/still_tone.h"

#include <array>
#include <cstddef>

namespace mfar::enlarge {

/// Pairs of grey levels of still and video, summed in 16 ranges of the still's level. The tone
/// curve interpolates linearly between the means of these ranges.
class ToneSums {
public:
    void add(double still, double video, double count = 1);
    /// Adds the pairs of `others`. The tone curve `tone` was applied to their stills before the
    /// levels were summed. It is inverted, so that the stills' original levels are added.
    void add(const ToneSums& others, const StillTone& tone);
    /// Multiplies all sums by the factor `share`.
    void fade(double share);

    using Curve = std::array<float, StillTone::kLevels>;
    /// Returns the video's level for each level of the still: interpolates between the means of the
    /// ranges, without ranges that have few pairs.
    [[nodiscard]] Curve curve() const;
    /// Returns curve(), made non-decreasing and rounded to whole grey levels. So it never makes the
    /// brighter of two pixels the darker one.
    [[nodiscard]] StillTone tone() const;
    /// Returns the mean absolute error of `tone` over all ranges [grey levels]. The error of a
    /// range is the difference between the mean level of the video and tone(mean level of the
    /// still). Each range is weighted with its number of pairs; ranges with few pairs do not count.
    /// Returns 0 if no range counts.
    [[nodiscard]] double distanceFrom(const StillTone& tone) const;

    /// stored() returns the sums, to be kept for a later run of mfard. restore() sets these sums,
    /// and returns false if a number is out of range.
    static constexpr std::size_t kRanges = 16, kNumbers = 3 * kRanges;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    struct Range {
        double count = 0, still = 0, video = 0;
    };
    std::array<Range, kRanges> ranges_;
};

/// Learns FilterBank::tone() from matched stills. A curve is used once two successive stills agree
/// on it, and until a still contradicts it. If the exposure changes from still to still, no curve
/// is right for the next still, and none is used.
class ToneLearner {
public:
    /// Learns from the pairs `seen`. Each pair consists of a still's grey level and the video's
    /// grey level at the same place. `applied` is the tone curve that was already applied to the
    /// still.
    void add(const ToneSums& seen, const StillTone& applied);
    [[nodiscard]] const StillTone& tone() const { return tone_; }

    /// stored() returns the state of the learner, to be kept for a later run of mfard. restore()
    /// sets this state, and returns false if a number is out of range. The last number is 1 if a
    /// curve is in use, otherwise 0.
    static constexpr std::size_t kNumbers = ToneSums::kNumbers + 1;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    ToneSums sums_;
    StillTone tone_;
};

}  // namespace mfar::enlarge
