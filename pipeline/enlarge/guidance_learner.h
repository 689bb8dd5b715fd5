#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Least squares for two factors: products of what is missing, of what the still would add and of
/// what taking the video's detail away would add.
struct FactorSums {
    double still2 = 0, video2 = 0, missing2 = 0;  ///< squares
    double stillVideo = 0, stillMissing = 0, videoMissing = 0;
    double pixels = 0;

    void add(const FactorSums& other);
    /// Counts what is there by this share from now on.
    void fade(double share);
    /// By how much the sum of squares falls with guidance.
    [[nodiscard]] double gainOf(const Guidance& of) const;
    /// What makes it fall most, where no guidance counts like `prior` pixels.
    [[nodiscard]] Guidance best(double prior) const;
};

/// Learns FilterBank::guidance() by leaving one still out: a frame is drawn with an older still,
/// and a new one tells what it should look like, where it matches that frame. Recursive least
/// squares with forgetting, drawn towards none; the result is used as long as
/// parts of the pictures that it was not learned from come nearer to the new still by it. The
/// weight of the detail is not learned this way: a still that was warped has lost a part of its
/// finest detail, so that one still asks for less of the other's than the scene does. On synthetic
/// scenes that factor comes out 0.25 to 0.35 too low. Guidance comes out too low as well, but is
/// never harmful for that.
class GuidanceLearner {
public:
    /// `truth`: the frame and the new still. `older`: the same frame and the still that it was
    /// drawn with. `filters`: what it is enlarged by. False: nothing was learned, as too little of
    /// both is trusted or `stop` asked for the end.
    bool add(const TrustedPairs& truth, const MatchedPictures& older, const FilterBank& filters,
             const std::stop_token& stop = {});

    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    /// Of the guidance, in the parts held out [dB].
    [[nodiscard]] double gainDb() const;

    /// What is kept for a later run, and the way back. False: not numbers that stored() gives.
    static constexpr std::size_t kNumbers = 17;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    Guidance guidance_;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
