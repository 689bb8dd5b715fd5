#pragma once

#include "pipeline/enlarge/matched_pictures.h"

namespace mfar {

/// Receives stills matched to the video. The calls come from the thread that processes frames, so
/// they must return soon. The arguments are valid only during the call.
class MatchListener {
public:
    virtual ~MatchListener() = default;
    /// Reports a still and the first frame that was matched with it in mode Detail. Not called if
    /// this frame was not enlarged with learned filters (Quality::learned).
    virtual void matched(const RgbPlanes& video, Rows<const std::uint8_t> still,
                         Rows<const LookUpCell> lookUps,
                         const MatchedPictures::LookedUp& lookedUp) = 0;
    /// Called when a new still replaces an old one, only in mode Detail and with Quality::learned.
    /// Reports the old still and the last frame that was drawn with it.
    virtual void replaced(const RgbPlanes& video, Rows<const std::uint8_t> still,
                          Rows<const LookUpCell> lookUps,
                          const MatchedPictures::LookedUp& lookedUp) {
        (void)video, (void)still, (void)lookUps, (void)lookedUp;
    }
};

}  // namespace mfar
