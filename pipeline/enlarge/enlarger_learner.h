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

/// Learns the enlarger's filters from stills matched to the video. The method is recursive least
/// squares in information form, per class, with the shipped filters as prior. Older pictures are
/// gradually forgotten.
/// The tiles of a picture form three parts. From the first part, filters are learned. In the second
/// part, the best filter of each class is selected: the new filter, the shipped filter, or a zero
/// filter, with which the result is Keys' cubic enlargement. A class with few pixels in the second
/// part keeps the shipped filter. In the third part, the selected filters are checked before use:
/// each class against Keys' cubic, and all classes together against the filters in use. After the
/// check, the still's third part is added to the second part of later stills. Each pixel belongs to
/// two classes; the mean of their two residuals is added to the cubic enlargement.
/// The same pictures in the same order give the same filters.
class EnlargerLearner {
public:
    EnlargerLearner();

    enum class Outcome {
        Replaced,  ///< filters() returns a new bank. Learned from the still, except if a refused
                   ///< still only caused the tone curve to be dropped
        Kept,      ///< learned from the still; filters() still returns the same bank
        Repeated,  ///< nothing learned: the still shows too little new
        Stopped,   ///< nothing learned: `stop` was requested
        Refused,   ///< nothing learned: few trusted pixels, a still hardly sharper than the video,
                   ///< or a still that contradicts the filters in use; in addOlder() also if
                   ///< the tone curves differ or GuidanceLearner::add() returns false
    };
    /// Learns from a still. If `stop` is requested, the call returns soon and nothing is learned.
    Outcome add(const MatchedPictures& pictures, const std::stop_token& stop = {});
    /// Learns the guidance (see enlarge::GuidanceLearner) from one frame and two stills. `truth` is
    /// the frame matched with the new still. `older` is the same frame matched with the older
    /// still, with which the frame was drawn.
    /// If the older still has no tone curve yet, it gets the curve that new stills get. If it has a
    /// curve that is not near that one (StillTone::isNear()), the result is Refused.
    Outcome addOlder(const MatchedPictures& truth, MatchedPictures& older,
                     const std::stop_token& stop = {});

    [[nodiscard]] std::shared_ptr<const FilterBank> filters() const { return inPlace_; }

    using Counts = LearnerCounts;
    [[nodiscard]] const Counts& counts() const { return counts_; }

    /// Returns the state of the learner, to be stored for a later run of mfard. `key` identifies
    /// the pair of sensors. Format: "mfarlern", little-endian numbers, then the FNV-1a checksum of
    /// all bytes before the checksum.
    [[nodiscard]] std::vector<std::uint8_t> stored(const std::string& key) const;
    /// Restores a learner from the result of stored(). Error messages contain `name`. Throws
    /// FilterBankError if the data is damaged, has an unknown format version or was stored with
    /// another key.
    [[nodiscard]] static EnlargerLearner restored(std::span<const std::uint8_t> bytes,
                                                  const std::string& key, const std::string& name);

private:
    enum class Part : std::uint8_t { Learn, Choose, Check };
    struct Errors {
        double cubic = 0, prior = 0, inPlace = 0, candidate = 0;
    };

    [[nodiscard]] static Part partOf(int column, int row);
    /// Finds the tiles that have changed since filters were last learned from them. Returns false
    /// if too few tiles have changed.
    bool findNew(const MatchedPictures& pictures);
    /// To be called after filters were learned from the tiles that findNew() found in a picture of
    /// size `video`.
    void rememberShown(Size video);
    struct StillSums {
        enlarge::SumsOfClasses learn, choose, check;
    };
    [[nodiscard]] StillSums sumsOf(const MatchedPictures& pictures,
                                   const enlarge::TrustedPairs& pairs,
                                   const std::stop_token& stop) const;
    /// True if the filters in use are worse than Keys' cubic on this still, but were not on the
    /// still before. Such a still is probably out of focus, and learning from it would discard all
    /// filters. If the next still contradicts the filters as well, the lens or the sensor has
    /// changed.
    [[nodiscard]] bool isOutlier(const StillSums& still);
    /// Counts a refused still and returns the outcome of add(). `tone`: the tone curve that was
    /// applied to the still. Drops the learned tone curve after several refused stills in a row.
    Outcome refusedWith(const StillTone& tone);
    bool choose(const enlarge::SumsOfClasses& check);
    [[nodiscard]] enlarge::ClassWeights solved(int unique) const;
    void learnTone(const enlarge::TrustedPairs& pairs, const StillTone& applied);
    bool putMatchInPlace();
    bool putInPlace(const std::vector<enlarge::ClassWeights>& weights,
                    const std::vector<bool>& learned);
    void measure();

    std::vector<enlarge::ClassWeights> prior_, current_;
    std::vector<bool> learned_;
    bool contradicted_ = false;  // see isOutlier()
    enlarge::SumsOfClasses sums_, held_;
    enlarge::GuidanceLearner guidance_;
    enlarge::FineMatchLearner fineMatch_;
    enlarge::ToneLearner tone_;
    int refusedInARow_ = 0;  // number of stills with a tone curve that were refused in a row
    std::shared_ptr<const FilterBank> inPlace_;
    // Means over blocks of 4x4 video pixels. `means_`: in the picture that was last given to
    // findNew(). `shown_`: in each tile when filters were last learned from this tile.
    // `shownSize_`: size of `shown_` [blocks].
    std::vector<std::uint8_t> shown_, means_;
    Size shownSize_{};
    std::vector<std::uint8_t> isNew_;
    Counts counts_;
};

}  // namespace mfar
