#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Sums over sub-pixels for a least-squares fit of the two factors of Guidance: squares and
/// products of three values. `still` is the detail that the still would add. `video` is the change
/// from removing the video's detail. `missing` is the detail that the drawn frame lacks. The fit
/// approximates `missing` by a weighted sum of `still` and `video`.
struct FactorSums {
    double still2 = 0, video2 = 0, missing2 = 0;
    double stillVideo = 0, stillMissing = 0, videoMissing = 0;
    double pixels = 0;

    void add(const FactorSums& other);
    void fade(double share);
    /// Returns by how much the guidance `of` reduces the sum of squared errors.
    [[nodiscard]] double gainOf(const Guidance& of) const;
    /// Returns the factors with the largest gainOf(). The prior is zero guidance; it counts as much
    /// as `prior` pixels.
    [[nodiscard]] Guidance best(double prior) const;
};

/// Learns FilterBank::guidance() by leaving one still out: a frame is drawn with an older still,
/// and a new still is its ground truth. The method is recursive least squares with forgetting; the
/// prior is zero guidance. Guidance is not learned from held-out tiles. It is used as long as it
/// brings these tiles closer to the new stills.
/// Only Guidance is learned in this way, not LookUpCell::weight, the weight of the whole detail of
/// a still. Warping removes a part of a still's finest detail, so the new still contains less
/// detail than the scene. A learned weight would be too low by 0.25 to 0.35 (synthetic scenes).
/// Guidance is too low for the same reason, which does no harm.
class GuidanceLearner {
public:
    /// Learns from a frame matched with two stills: with the new still (`truth`), and with the
    /// older still with which it was drawn (`older`). Returns false if too few pixels are trusted
    /// in both stills or `stop` was requested.
    bool add(const TrustedPairs& truth, const MatchedPictures& older, const FilterBank& filters,
             const std::stop_token& stop = {});

    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    [[nodiscard]] double gainDb() const;

    /// stored() returns the learner's state for a later run of mfard. restore() returns false if a
    /// number is out of range.
    static constexpr std::size_t kNumbers = 17;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    Guidance guidance_;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
