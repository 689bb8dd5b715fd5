#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"

#include <array>
#include <cstddef>
#include <stop_token>

namespace mfar::enlarge {

/// Learns FilterBank::fineMatch() from stills that were matched: of all cells that are trusted, the
/// noise is what a tenth leaves unexplained, and the share is what half of those with structure do
/// beyond that: a part of the picture that is matched wrongly does not decide. Mean of the last
/// stills.
class FineMatchLearner {
public:
    /// False: too few cells are trusted or have structure, or `stop` asked for the end.
    bool add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    [[nodiscard]] const FineMatch& fineMatch() const { return match_; }

    /// What is kept for a later run, and the way back. False: not numbers that stored() gives.
    static constexpr std::size_t kNumbers = 3;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FineMatch match_;
    double stills_ = 0;  // that count
};

}  // namespace mfar::enlarge
