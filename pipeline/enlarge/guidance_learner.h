#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Least squares for two factors: products of the missing detail, the detail that the still would
/// add, and the detail that removing the video's own would add.
struct FactorSums {
    double still2 = 0, video2 = 0, missing2 = 0;  ///< squares
    double stillVideo = 0, stillMissing = 0, videoMissing = 0;
    double pixels = 0;

    void add(const FactorSums& other);
    /// Multiplies all sums by `share`.
    void fade(double share);
    /// By how much guidance reduces the sum of squared errors.
    [[nodiscard]] double gainOf(const Guidance& of) const;
    /// The factors with the largest gain, with zero guidance as a prior that has the weight of
    /// `prior` pixels.
    [[nodiscard]] Guidance best(double prior) const;
};

/// Learns FilterBank::guidance() by leaving one still out: a frame is drawn with an older still,
/// and a new still serves as ground truth where it matches that frame. Recursive least squares with
/// forgetting and zero guidance as prior. The result is used as long as it brings held-out parts of
/// the pictures closer to the new still. The weight of the detail is not learned this way: warping
/// removes a part of a still's finest detail, so that one warped still asks for less of the other's
/// detail than the scene has. On synthetic scenes that factor is 0.25 to 0.35 too low. Guidance is
/// too low as well, but that does no harm.
class GuidanceLearner {
public:
    /// `truth`: the frame and the new still. `older`: the same frame and the still that it was
    /// drawn with. `filters`: the enlarger's filters. False: nothing was learned, because too few
    /// pixels are trusted in both or a stop was requested.
    bool add(const TrustedPairs& truth, const MatchedPictures& older, const FilterBank& filters,
             const std::stop_token& stop = {});

    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    /// Gain of the guidance in the held-out parts [dB].
    [[nodiscard]] double gainDb() const;

    /// Numbers of stored(), for a later run, which restore() reads. False: numbers out of range.
    static constexpr std::size_t kNumbers = 17;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    Guidance guidance_;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
