#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Sums of products for a least-squares fit of the two factors of Guidance. Per sub-pixel, `still`
/// is the detail that the still would add, `video` the change by removing the video's detail, and
/// `missing` the detail that the drawn frame lacks. The fit approximates `missing` by a weighted
/// sum of `still` and `video`.
struct FactorSums {
    double still2 = 0, video2 = 0, missing2 = 0;  ///< sums of squares
    double stillVideo = 0, stillMissing = 0, videoMissing = 0;
    double pixels = 0;

    void add(const FactorSums& other);
    /// Multiplies all sums by the factor `share`.
    void fade(double share);
    /// Returns by how much guidance reduces the sum of squared errors.
    [[nodiscard]] double gainOf(const Guidance& of) const;
    /// Returns the factors for which gainOf() is largest. The prior of the fit is zero guidance; it
    /// counts as much as `prior` pixels.
    [[nodiscard]] Guidance best(double prior) const;
};

/// Learns FilterBank::guidance() by leaving one still out: a frame was drawn with an older still,
/// and a new still serves as ground truth where it matches that frame. The method is recursive
/// least squares with forgetting; the prior is zero guidance. A part of each picture is held out:
/// guidance is not learned from it. The learned guidance is used as long as it brings the held-out
/// parts closer to the new stills.
///
/// The weight of the still's detail is not learned in this way. Warping removes a part of a still's
/// finest detail. The warped new still therefore contains less detail than the scene, and the
/// learned weight would be too low: by 0.25 to 0.35 on synthetic scenes. Guidance is learned too
/// low for the same reason, but that does no harm.
class GuidanceLearner {
public:
    /// `truth`: the frame and the new still. `older`: the same frame and the older still that it
    /// was drawn with. `filters`: the enlarger's filters. Returns false if nothing was learned,
    /// because too few pixels are trusted in both stills or `stop` was requested.
    bool add(const TrustedPairs& truth, const MatchedPictures& older, const FilterBank& filters,
             const std::stop_token& stop = {});

    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    /// Gain of guidance over no guidance in the held-out tiles [dB].
    [[nodiscard]] double gainDb() const;

    /// stored() returns the learner's state for a later run of mfard. restore() sets this state,
    /// and returns false if a number is out of range.
    static constexpr std::size_t kNumbers = 17;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    Guidance guidance_;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
