#pragma once

#include "pipeline/enlarge/enlarger_learner.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/match_listener.h"
#include "pipeline/frame_matcher.h"

#include <memory>
#include <optional>

namespace mfar::eval {

/// Learns from every still that a pipeline matches, as the daemon does. It learns in the pipeline's
/// thread, so equal pictures give equal filters.
class StillLearning final : public MatchListener {
public:
    /// Call this before the first still of a pipeline with this rig.
    void begin(const StereoRig& rig);
    /// True (default): the next still serves as the truth of the last frame, to learn guidance.
    /// False: it does not. Set false if that still shows the frame's own view, see showsOwnView().
    void setMayUseOlder(bool may) { mayUseOlder_ = may; }
    [[nodiscard]] std::shared_ptr<const FilterBank> filters() const { return learner_.filters(); }
    /// Prints one line to stderr that tells what was learned.
    void report(const char* program = "mfar-eval") const;

    void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                 Rows<const LookUpCell> lookUps,
                 const MatchedPictures::LookedUp& lookedUp) override;
    void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                  Rows<const LookUpCell> lookUps,
                  const MatchedPictures::LookedUp& lookedUp) override;

private:
    MatchedPictures pictures_, older_, truth_;
    RgbPlanes olderVideo_{Size{1, 1}};
    bool hasOlder_ = false, mayUseOlder_ = true;
    std::optional<FrameMatcher> matcher_;
    EnlargerLearner learner_;
};

}  // namespace mfar::eval
