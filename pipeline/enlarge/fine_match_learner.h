#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstddef>
#include <stop_token>

namespace mfar::enlarge {

/// Learns FilterBank::fineMatch() from matched stills, as a mean over the last stills.
/// FineMatch::noise is the 10 % quantile of the unexplained variance over all trusted cells.
/// FineMatch::share is the median of (unexplained variance - noise) / variance over the cells with
/// structure. Quantiles are used because wrongly matched parts of the picture hardly influence
/// them.
class FineMatchLearner {
public:
    /// Learns from a still that was matched to the video. Returns false if nothing was learned,
    /// because too few cells are trusted or have structure or because `stop` was requested.
    bool add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    [[nodiscard]] const FineMatch& fineMatch() const { return match_; }

    /// stored() returns the learner's state for a later run of mfard. restore() sets this state,
    /// and returns false if a number is out of range.
    static constexpr std::size_t kNumbers = 3;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FineMatch match_;
    double stills_ = 0;  // number of stills over which match_ is a mean
};

}  // namespace mfar::enlarge
