#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstddef>
#include <stop_token>

namespace mfar::enlarge {

/// Learns FilterBank::fineMatch() as a mean over the last matched stills. It measures the
/// unexplained variance of each trusted cell: the part of the variance of the video's finest detail
/// that the still does not predict. FineMatch::noise is the 10 % quantile of the unexplained
/// variance over all trusted cells. FineMatch::share is the median of ((unexplained variance) -
/// noise) / (variance of the video's finest detail) over the trusted cells in which this variance
/// clearly exceeds the noise. Quantiles are used because wrongly matched parts of the picture
/// hardly influence them.
class FineMatchLearner {
public:
    /// Learns from a matched still. Returns false if too few cells are trusted, if too few of them
    /// have finest detail above the noise, or if `stop` was requested.
    bool add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    [[nodiscard]] const FineMatch& fineMatch() const { return match_; }

    /// stored() returns the state of the learner, to be kept for a later run of mfard. restore()
    /// returns false if a number is out of range.
    static constexpr std::size_t kNumbers = 3;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FineMatch match_;
    double stills_ = 0;
};

}  // namespace mfar::enlarge
