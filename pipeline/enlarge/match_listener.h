#pragma once

#include "pipeline/enlarge/matched_pictures.h"

namespace mfar {

/// Receives stills that were matched to the video.
class MatchListener {
public:
    virtual ~MatchListener() = default;
    /// The first frame that a still was matched to, in mode Detail; on the frame's thread, which it
    /// must not keep. All is borrowed for the call.
    virtual void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                         Rows<const LookUpCell> lookUps,
                         const MatchedPictures::LookedUp& lookedUp) = 0;
    /// Before a new still takes the place of one: what was drawn last, and how that still was
    /// matched to it. On the frame's thread, too, and borrowed for the call.
    virtual void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                          Rows<const LookUpCell> lookUps,
                          const MatchedPictures::LookedUp& lookedUp) {
        (void)video, (void)still, (void)lookUps, (void)lookedUp;
    }
};

}  // namespace mfar
