#include "tests/measure/eval/still_learning.h"

#include <fmt/format.h>

#include <cstdio>

namespace mfar::eval {

void StillLearning::begin(const StereoRig& rig) {
    matcher_.emplace(rig);
    hasOlder_ = false;
}

void StillLearning::matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                            Rows<const LookUpCell> lookUps,
                            const MatchedPictures::LookedUp& lookedUp) {
    pictures_.take(video, still, lookUps, lookedUp);
    learner_.add(pictures_);
    if (!hasOlder_) return;
    hasOlder_ = false;
    matcher_->match(olderVideo_, still, learner_.filters()->guidance().light, truth_);
    learner_.addOlder(truth_, older_);
}

void StillLearning::replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                             Rows<const LookUpCell> lookUps,
                             const MatchedPictures::LookedUp& lookedUp) {
    hasOlder_ = mayUseOlder_;
    if (!hasOlder_) return;
    older_.take(video, still, lookUps, lookedUp);
    olderVideo_ = video;
}

void StillLearning::report(const char* program) const {
    const EnlargerLearner::Counts& counts = learner_.counts();
    fmt::print(
        stderr,
        "{}: learned from {} stills ({} refused, {} showed nothing new). {} of {} classes have a "
        "learned filter. On pixels kept for the check, learned filters gain {:.2f} dB over "
        "bicubic, shipped filters {:.2f} dB. Guidance, learned from {} pairs of stills, adds "
        "{:.2f} of the still's finest detail and removes {:.2f} of the video's, with a light "
        "factor of {:.2f} (0: a video pixel averages grey levels, 1: light); on pixels of its "
        "check, this gains {:.2f} dB over no guidance. A well matched still does not predict all "
        "of the video's finest detail: the variance of the rest is {:.2f} grey levels^2 + {:.3f} "
        "times the whole variance\n",
        program, counts.stills, counts.refused, counts.repeated, counts.classes, enlarge::kUnique,
        counts.gainDb, counts.priorDb, counts.pairs, counts.guidance.still, counts.guidance.video,
        counts.guidance.light, counts.guidanceGainDb, counts.fineMatch.noise,
        counts.fineMatch.share);
}

}  // namespace mfar::eval
