#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstddef>
#include <stop_token>

namespace mfar::enlarge {

/// Learns FilterBank::fineMatch() from matched stills, as the mean of the last stills. Over all
/// trusted cells, the noise is the 10 % quantile of the unexplained variance. Over cells with
/// structure, the share is the median of the unexplained variance beyond the noise, relative to the
/// variance. Quantiles, so that a wrongly matched part of the picture has no influence.
class FineMatchLearner {
public:
    /// False: too few cells are trusted or have structure, or a stop was requested.
    bool add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    [[nodiscard]] const FineMatch& fineMatch() const { return match_; }

    /// Numbers of stored(), for a later run, which restore() reads. False: numbers out of range.
    static constexpr std::size_t kNumbers = 3;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FineMatch match_;
    double stills_ = 0;  // number of stills in the mean
};

}  // namespace mfar::enlarge
