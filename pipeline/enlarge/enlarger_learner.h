#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "pipeline/enlarge/fine_match_learner.h"
#include "pipeline/enlarge/guidance_learner.h"
#include "pipeline/enlarge/learner_counts.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/tone_sums.h"
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
/// parts. Filters are learned on the first part. On the second part, the best filter of each class
/// is chosen: its new filter, the shipped filter or a zero filter, which leaves the enlargement by
/// Keys' cubic unchanged. A class with few pixels keeps the shipped filter. On the third part, the
/// chosen filters are checked before they are used: the filter of each class against Keys' cubic,
/// and all filters together against those in use. Each pixel belongs to two classes, and the mean
/// of both residuals is added to the cubic enlargement. If neither residual makes the enlargement
/// worse, their mean does not either. The same pictures in the same order give the same filters.
class EnlargerLearner {
public:
    EnlargerLearner();

    enum class Outcome {
        Replaced,  ///< the still was learned from, and new filters are in use
        Kept,      ///< the still was learned from, but the filters in use are as good or better
                   ///< than the new ones
        Repeated,  ///< the still shows nothing new, so nothing was learned
        Stopped,   ///< `stop` was requested
        Refused,   ///< nothing was learned: too few pixels are trusted, or the still is no sharper
                   ///< than the video
    };
    /// Learns from a still. If `stop` is requested, the call returns soon and nothing is learned.
    Outcome add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    /// Learns the guidance, see enlarge::GuidanceLearner. `truth`: a frame matched with a new
    /// still. `older`: the same frame matched with the older still that it was drawn with. Refused
    /// if this still had another tone curve than stills have now.
    Outcome addOlder(const MatchedPictures& truth, const MatchedPictures& older,
                     const std::stop_token& stop = {});

    /// The filters in use. Never null; initially the shipped filters.
    [[nodiscard]] std::shared_ptr<const FilterBank> filters() const { return inPlace_; }

    using Counts = LearnerCounts;
    [[nodiscard]] const Counts& counts() const { return counts_; }

    /// Returns the learner's state for a later run of mfard. `key` identifies the pair of sensors.
    /// Format: "mfarlern", then little-endian numbers, then the FNV-1a checksum of all of this.
    [[nodiscard]] std::vector<std::uint8_t> stored(const std::string& key) const;
    /// Restores a learner from the data of stored(). `name`: the name of the data in error
    /// messages. Throws FilterBankError if the data is incomplete or was stored with another key.
    [[nodiscard]] static EnlargerLearner restored(std::span<const std::uint8_t> bytes,
                                                  const std::string& key, const std::string& name);

private:
    /// What the pixels of a tile are used for.
    enum class Part : std::uint8_t { Learn, Choose, Check };
    struct Errors {
        double cubic = 0, prior = 0, inPlace = 0, candidate = 0;
    };

    [[nodiscard]] static Part partOf(int column, int row);
    /// Finds the tiles whose content has changed since the last picture that was learned from
    /// there. Returns false if too few tiles have changed.
    bool findNew(const MatchedPictures& pictures);
    void rememberShown();
    /// Sums over the pixels of one still, for each Part.
    struct StillSums {
        enlarge::SumsOfClasses learn, choose, check;
    };
    [[nodiscard]] StillSums sumsOf(const MatchedPictures& pictures,
                                   const enlarge::TrustedPairs& pairs,
                                   const std::stop_token& stop) const;
    bool choose(const enlarge::SumsOfClasses& check);
    [[nodiscard]] enlarge::ClassWeights solved(int unique) const;
    void learnTone(const enlarge::TrustedPairs& pairs, const StillTone& applied);
    bool putMatchInPlace();
    bool putInPlace(const std::vector<enlarge::ClassWeights>& weights,
                    const std::vector<bool>& learned);
    void measure();

    std::vector<enlarge::ClassWeights> prior_, current_;
    std::vector<bool> learned_;  // per class: true if its filter in current_ is a learned one
    enlarge::SumsOfClasses sums_, held_;
    enlarge::GuidanceLearner guidance_;
    enlarge::FineMatchLearner fineMatch_;
    enlarge::ToneLearner tone_;
    std::shared_ptr<const FilterBank> inPlace_;
    // Means over 4x4 video pixels. shown_: for each tile, of the last picture that was learned from
    // there; means_: of the last picture given to findNew().
    std::vector<std::uint8_t> shown_, means_;
    Size shownSize_{};
    std::vector<std::uint8_t> isNew_;  // per tile: 1 if findNew() found that it changed
    Counts counts_;
};

}  // namespace mfar
