#pragma once

#include "pipeline/enlarge/matched_pictures.h"

namespace mfar {

/// Interface for an object that receives stills matched to the video.
class MatchListener {
public:
    virtual ~MatchListener() = default;
    /// Reports a still and the first frame that was matched with it. Called in mode Detail only.
    /// Called on the thread that processes frames, so it must return soon. The arguments are valid
    /// only during the call.
    virtual void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                         Rows<const LookUpCell> lookUps,
                         const MatchedPictures::LookedUp& lookedUp) = 0;
    /// Reports the frame drawn last and the old still that was matched to it. Called before a new
    /// still replaces the old one. Called on the thread that processes frames. The arguments are
    /// valid only during the call.
    virtual void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                          Rows<const LookUpCell> lookUps,
                          const MatchedPictures::LookedUp& lookedUp) {
        (void)video, (void)still, (void)lookUps, (void)lookedUp;
    }
};

}  // namespace mfar
