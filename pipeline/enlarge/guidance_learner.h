#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Sums over sub-pixels from which the two factors of Guidance are fitted by least squares. They
/// are sums of squares and products of three values. `still` is the detail that the still would
/// add. `video` is the change if the video's own detail is removed. `missing` is the new still
/// minus the frame as drawn without guidance. The fit approximates `missing` by a weighted sum of
/// `still` and `video`.
struct FactorSums {
    double still2 = 0, video2 = 0, missing2 = 0;
    double stillVideo = 0, stillMissing = 0, videoMissing = 0;
    double pixels = 0;

    void add(const FactorSums& other);
    void fade(double share);
    /// Returns by how much the sum of squared errors decreases with the guidance `of`.
    [[nodiscard]] double gainOf(const Guidance& of) const;
    /// Returns the factors with the largest gainOf(). The prior of the fit is zero guidance. It
    /// counts as much as `prior` pixels.
    [[nodiscard]] Guidance best(double prior) const;
};

/// Learns FilterBank::guidance(). A new still shows what a frame that was drawn with an older still
/// should have looked like. Guidance is the pair of factors with which the frame would have been
/// most similar to the new still. The method is recursive least squares with forgetting, and its
/// prior is zero guidance. Some tiles are used for a check and not for learning: guidance is used
/// only while it makes these tiles more similar to the new stills.
///
/// The weight of the whole detail of a still (LookUpCell::weight) is not learned in this way.
/// Warping removes a part of a still's finest detail, so the warped new still has less detail than
/// the scene. A learned weight would be too low by 0.25 to 0.35 (synthetic scenes). Guidance is too
/// low for the same reason, which is harmless.
class GuidanceLearner {
public:
    /// Learns from one frame that was matched with two stills. `truth` is its match with the new
    /// still. `older` is its match with the older still, with which the frame was drawn. Returns
    /// false if too few pixels are trusted in both stills, or if `stop` was requested.
    bool add(const TrustedPairs& truth, const MatchedPictures& older, const FilterBank& filters,
             const std::stop_token& stop = {});

    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    [[nodiscard]] double gainDb() const;

    /// stored() returns the state of the learner, to be kept for a later run of mfard. restore()
    /// returns false if a number is out of range.
    static constexpr std::size_t kNumbers = 17;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    Guidance guidance_;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
