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
/// least squares in information form, class by class. Older pictures are gradually forgotten, and
/// the filters shipped with the product serve as a prior. The picture is divided into parts to
/// learn from, to choose on and to check on. On the second, each class chooses between its new
/// filter, the shipped one and a zero filter, which leaves the cubic; a class with few pixels keeps
/// the shipped one. The third part checks the set before it is put in place: each class against the
/// cubic, and the sum against the set in place. An enlarged picture is the mean of two residuals;
/// if neither is worse than the cubic, the mean is no worse either.
/// The same pictures in the same order give the same filters.
class EnlargerLearner {
public:
    EnlargerLearner();

    enum class Outcome {
        Replaced,  ///< learned from, and a new set of filters is in place
        Kept,      ///< learned from; the filters in place are as good or better
        Repeated,  ///< nothing learned: shows only what was learned from before
        Stopped,   ///< `stop` was requested
        Refused,   ///< too few pixels are trusted, or the still is no sharper than the video
    };
    /// `stop`: ends the work soon; nothing is learned.
    Outcome add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    /// Learns guidance, see enlarge::GuidanceLearner. `truth`: a frame and a new still. `older`:
    /// the same frame and the still that it was drawn with.
    Outcome addOlder(const MatchedPictures& truth, const MatchedPictures& older,
                     const std::stop_token& stop = {});

    /// The filters in place. Never null; initially the shipped ones.
    [[nodiscard]] std::shared_ptr<const FilterBank> filters() const { return inPlace_; }

    using Counts = LearnerCounts;
    [[nodiscard]] const Counts& counts() const { return counts_; }

    /// Sums and filters for a later run. `key` identifies the sensors that they were learned from.
    /// Format: "mfarlern", then little-endian numbers and their FNV-1a sum.
    [[nodiscard]] std::vector<std::uint8_t> stored(const std::string& key) const;
    /// Continues from stored() data. `name` is for messages. Throws FilterBankError for incomplete
    /// data or another key.
    [[nodiscard]] static EnlargerLearner restored(std::span<const std::uint8_t> bytes,
                                                  const std::string& key, const std::string& name);

private:
    /// The use of a tile of the picture.
    enum class Part : std::uint8_t { Learn, Choose, Check };
    struct Errors {
        double cubic = 0, prior = 0, inPlace = 0, candidate = 0;
    };

    [[nodiscard]] static Part partOf(int column, int row);
    /// Finds the tiles that have changed since they were learned from. False: too few.
    bool findNew(const MatchedPictures& pictures);
    void rememberShown();
    /// Sums of one still, by part.
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
    std::vector<bool> learned_;  // per class: `current_` has neither the shipped filter nor zero
    enlarge::SumsOfClasses sums_, held_;
    enlarge::GuidanceLearner guidance_;
    enlarge::FineMatchLearner fineMatch_;
    std::shared_ptr<const FilterBank> inPlace_;
    // Means of 4x4 pixels: of the pictures last learned from, and of the last picture.
    std::vector<std::uint8_t> shown_, means_;
    Size shownSize_{};
    std::vector<std::uint8_t> isNew_;  // per tile
    Counts counts_;
};

}  // namespace mfar
