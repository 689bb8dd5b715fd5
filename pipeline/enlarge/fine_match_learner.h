#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstddef>
#include <stop_token>

namespace mfar::enlarge {

/// Learns FilterBank::fineMatch() from matched stills, as a mean over the last stills. The noise is
/// the 10 % quantile of the unexplained variance over all trusted cells. The share is the median of
/// (unexplained variance - noise) / variance over the cells with structure. Quantiles are used so
/// that a wrongly matched part of the picture has no influence.
class FineMatchLearner {
public:
    /// Returns false if too few cells are trusted or have structure, or if a stop was requested.
    bool add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    [[nodiscard]] const FineMatch& fineMatch() const { return match_; }

    /// stored() returns the state for a later run. restore() reads it, and returns false if a
    /// number is out of range.
    static constexpr std::size_t kNumbers = 3;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FineMatch match_;
    double stills_ = 0;  // number of stills in the mean
};

}  // namespace mfar::enlarge
