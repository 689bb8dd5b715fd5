#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Least squares for one factor: what is missing, and what the factor would add to it.
struct FactorSums {
    double added = 0, product = 0, missing = 0;  ///< squares of the one, of both, of the other
    double pixels = 0;

    void add(const FactorSums& other);
    /// Counts what is there by this share from now on.
    void fade(double share);
    /// By how much the sum of squares falls with a factor.
    [[nodiscard]] double gainOf(double factor) const {
        return factor * (2 * product - factor * added);
    }
};

/// Learns FilterBank::guidance() by leaving one still out: a frame is drawn with an older still,
/// and a new one tells what it should look like, where it matches that frame. Recursive least
/// squares with forgetting, drawn towards 0, which is as without; the result is used as long as
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

    [[nodiscard]] float guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    /// Of the guidance, in the parts held out [dB].
    [[nodiscard]] double gainDb() const;

    /// What is kept for a later run, and the way back. False: not numbers that stored() gives.
    static constexpr std::size_t kNumbers = 10;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    float guidance_ = 0;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
