#pragma once

#include "pipeline/enlarge/matched_pictures.h"

namespace mfar {

/// Receives stills that were matched to the video.
class MatchListener {
public:
    virtual ~MatchListener() = default;
    /// Reports the first frame that a still was matched to, in mode Detail. Called on the thread
    /// that processes frames, so it must return soon. The arguments are valid only during the call.
    virtual void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                         Rows<const LookUpCell> lookUps,
                         const MatchedPictures::LookedUp& lookedUp) = 0;
    /// Called before a new still replaces the old one. Reports the frame drawn last, and how the
    /// old still was matched to it. Called on the thread that processes frames. The arguments are
    /// valid only during the call.
    virtual void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                          Rows<const LookUpCell> lookUps,
                          const MatchedPictures::LookedUp& lookedUp) {
        (void)video, (void)still, (void)lookUps, (void)lookedUp;
    }
};

}  // namespace mfar
