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

/// Learns the filters of the enlarger from stills that were matched to the video: recursive least
/// squares in information form, class by class, that older pictures are forgotten from and that is
/// drawn towards the filters that the product ships. A part of the picture is never learned from.
/// There each class chooses between its new filter, the shipped one and none, which is the cubic;
/// a class with few pixels keeps the shipped one. Another part checks the set as a whole before it
/// is put in place, class by class against the cubic and in sum against the set before it: pictures
/// that are the mean of two residuals, neither worse than none, are no worse than the cubic.
/// The same pictures in the same order give the same filters.
class EnlargerLearner {
public:
    EnlargerLearner();

    enum class Outcome {
        Replaced,  ///< learned from, and a new set of filters is in place
        Kept,      ///< learned from; the filters in place do better or are as good
        Repeated,  ///< shows what was learned from already
        Stopped,   ///< when it was asked to
        Refused,   ///< too little is trusted, or the still is no sharper than the video
    };
    /// `stop`: ends the work soon, with nothing learned.
    Outcome add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    /// Learns guidance, see enlarge::GuidanceLearner: `truth` is a frame and a new still, `older`
    /// the same frame and the still that it was drawn with.
    Outcome addOlder(const MatchedPictures& truth, const MatchedPictures& older,
                     const std::stop_token& stop = {});

    /// What is in place. Never null; the shipped ones at first.
    [[nodiscard]] std::shared_ptr<const FilterBank> filters() const { return inPlace_; }

    using Counts = LearnerCounts;
    [[nodiscard]] const Counts& counts() const { return counts_; }

    /// Sums and filters for a later run, with what they were learned from: "mfarlern", then
    /// little-endian numbers and their FNV-1a sum.
    [[nodiscard]] std::vector<std::uint8_t> stored(const std::string& key) const;
    /// Goes on from there. `name` is for messages. Throws FilterBankError for anything that is not
    /// whole or of another key.
    [[nodiscard]] static EnlargerLearner restored(std::span<const std::uint8_t> bytes,
                                                  const std::string& key, const std::string& name);

private:
    /// What a tile of the picture is used for.
    enum class Part : std::uint8_t { Learn, Choose, Check };
    struct Errors {
        double cubic = 0, prior = 0, inPlace = 0, candidate = 0;
    };

    [[nodiscard]] static Part partOf(int column, int row);
    /// Which tiles have changed since they were learned from.
    bool findNew(const MatchedPictures& pictures);
    void rememberShown();
    /// Sums of one still.
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
    std::vector<bool> learned_;  // of each class: `current_` is no shipped filter and not zero
    enlarge::SumsOfClasses sums_, held_;
    enlarge::GuidanceLearner guidance_;
    enlarge::FineMatchLearner fineMatch_;
    std::shared_ptr<const FilterBank> inPlace_;
    // Means of 4x4 pixels: those that were learned from, and the last picture's.
    std::vector<std::uint8_t> shown_, means_;
    Size shownSize_{};
    std::vector<std::uint8_t> isNew_;  // of each tile
    Counts counts_;
};

}  // namespace mfar
