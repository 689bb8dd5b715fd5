#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "pipeline/enlarge/fine_match_learner.h"
#include "pipeline/enlarge/guidance_learner.h"
#include "pipeline/enlarge/learner_counts.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace mfar {

/// Learns the filters of the enlarger from stills that were matched to the video, by recursive
/// least squares in information form, for each class separately. Older pictures are gradually
/// forgotten; the shipped filters are the prior. The tiles of the picture are divided into three
/// parts. Filters are learned on the first part. On the second part, each class chooses between its
/// new filter, the shipped filter and a zero filter, which leaves the cubic unchanged; a class with
/// few pixels keeps the shipped filter. The third part checks the chosen filters before they are
/// used: each class against the cubic, and all of them together against the filters in use. Each
/// pixel belongs to two classes, and the mean of their two residuals is added to the cubic. If
/// neither residual makes the cubic worse, their mean does not either. The same pictures in the
/// same order give the same filters.
class EnlargerLearner {
public:
    EnlargerLearner();

    enum class Outcome {
        Replaced,  ///< the still was learned from, and new filters are in use
        Kept,      ///< the still was learned from; the filters in use are as good or better
        Repeated,  ///< the still shows nothing new, so nothing was learned
        Stopped,   ///< `stop` was requested
        Refused,   ///< too few pixels are trusted, or the still is no sharper than the video
    };
    /// Learns from a still. If `stop` is requested, the call returns soon and nothing is learned.
    Outcome add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    /// Learns guidance, see enlarge::GuidanceLearner. `truth`: a frame and a new still. `older`:
    /// the same frame and the older still that it was drawn with.
    Outcome addOlder(const MatchedPictures& truth, const MatchedPictures& older,
                     const std::stop_token& stop = {});

    /// The filters in use. Never null; initially the shipped filters.
    [[nodiscard]] std::shared_ptr<const FilterBank> filters() const { return inPlace_; }

    using Counts = LearnerCounts;
    [[nodiscard]] const Counts& counts() const { return counts_; }

    /// Returns the sums and filters for a later run. `key` identifies the pair of sensors. Format:
    /// "mfarlern", then little-endian numbers, then their FNV-1a checksum.
    [[nodiscard]] std::vector<std::uint8_t> stored(const std::string& key) const;
    /// Continues from the data of stored(). `name` is used in messages. Throws FilterBankError if
    /// the data is incomplete or has another key.
    [[nodiscard]] static EnlargerLearner restored(std::span<const std::uint8_t> bytes,
                                                  const std::string& key, const std::string& name);

private:
    /// Use of a tile of the picture.
    enum class Part : std::uint8_t { Learn, Choose, Check };
    struct Errors {
        double cubic = 0, prior = 0, inPlace = 0, candidate = 0;
    };

    [[nodiscard]] static Part partOf(int column, int row);
    /// Finds the tiles that have changed since they were last learned from. Returns false if too
    /// few have changed.
    bool findNew(const MatchedPictures& pictures);
    void rememberShown();
    /// Sums over one still, for each part.
    struct StillSums {
        enlarge::SumsOfClasses learn, choose, check;
    };
    [[nodiscard]] StillSums sumsOf(const MatchedPictures& pictures,
                                   const enlarge::TrustedPairs& pairs,
                                   const std::stop_token& stop) const;
    bool choose(const enlarge::SumsOfClasses& check);
    [[nodiscard]] enlarge::ClassWeights solved(int unique) const;
    bool putFineMatchInPlace();
    bool putInPlace(const std::vector<enlarge::ClassWeights>& weights,
                    const std::vector<bool>& learned);
    void measure();

    std::vector<enlarge::ClassWeights> prior_, current_;
    std::vector<bool> learned_;  // per class: `current_` is not the shipped filter or zero
    enlarge::SumsOfClasses sums_, held_;
    enlarge::GuidanceLearner guidance_;
    enlarge::FineMatchLearner fineMatch_;
    std::shared_ptr<const FilterBank> inPlace_;
    // Means of 4x4 pixels: shown_ of the pictures last learned from, means_ of the last picture.
    std::vector<std::uint8_t> shown_, means_;
    Size shownSize_{};
    std::vector<std::uint8_t> isNew_;  // one entry per tile
    Counts counts_;
};

}  // namespace mfar
