#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/match_listener.h"
#include "tests/oracle/upscale.h"

namespace mfar {

/// How two sensors see the same scene, and the quality of their matches.
struct SensorPair {
    int videoBlur = 0;      ///< number of 1 2 1 blurs of the video, in both directions
    double videoNoise = 0;  ///< standard deviations [grey levels]
    double stillNoise = 0;
    double gain = 1, gamma = 1;  ///< of the still
    int stillBlur = 0;           ///< number of 1 2 1 blurs of the still, on its pixels
    double shift = 0;            ///< error of all look-ups [video px]
    double weight = 1, confidence = 1;
    unsigned seed = 1;
};

/// Random discs, with edges of all directions, in a picture of four times the video's size.
[[nodiscard]] twin::Grey sharpDiscs(unsigned seed, Size video = {256, 192});
/// The picture as the video's sensor sees it, in whole grey levels.
[[nodiscard]] twin::Grey videoOf(const twin::Grey& sharp, const SensorPair& pair);
/// Calls the listener's matched() with the video and a still that shows `still`.
void showTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
            const SensorPair& pair);
/// Calls the listener's replaced(), for a still that is about to be replaced.
void showReplacedTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
                    const SensorPair& pair);
[[nodiscard]] MatchedPictures matchedPictures(const twin::Grey& sharp, const twin::Grey& still,
                                              const SensorPair& pair);
[[nodiscard]] inline MatchedPictures matchedPictures(const twin::Grey& sharp,
                                                     const SensorPair& pair) {
    return matchedPictures(sharp, sharp, pair);
}

/// Mean squared error of a video enlarged with these filters, or with Keys' cubic for null [grey
/// levels^2].
[[nodiscard]] double enlargingError(const twin::Grey& sharp, const SensorPair& pair,
                                    const FilterBank* bank);

}  // namespace mfar
