#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstddef>
#include <stop_token>

namespace mfar::enlarge {

/// Learns FilterBank::fineMatch() as a mean over the last matched stills. FineMatch::noise is the
/// 10 % quantile, over all trusted cells, of the variance that the still does not predict.
/// FineMatch::share is the median of (this variance - noise) / variance over cells with structure.
/// Wrongly matched parts of the picture hardly influence quantiles.
class FineMatchLearner {
public:
    /// Learns from a matched still. Returns false if too few cells are trusted or have structure,
    /// or if `stop` was requested.
    bool add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    [[nodiscard]] const FineMatch& fineMatch() const { return match_; }

    /// stored() returns the learner's state for a later run of mfard. restore() returns false if a
    /// number is out of range.
    static constexpr std::size_t kNumbers = 3;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FineMatch match_;
    double stills_ = 0;
};

}  // namespace mfar::enlarge
