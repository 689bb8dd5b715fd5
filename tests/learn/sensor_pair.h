#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/match_listener.h"
#include "tests/oracle/upscale.h"

namespace mfar {

/// Model of two sensors that see the same scene, and of the errors of their match.
struct SensorPair {
    int videoBlur = 0;           ///< how often the video is blurred by (1 2 1)/4 along both axes
    double videoNoise = 0;       ///< standard deviation [grey levels]
    double stillNoise = 0;       ///< standard deviation [grey levels]
    double gain = 1, gamma = 1;  ///< exposure and tone curve of the still
    int stillBlur = 0;           ///< how often the still is blurred by (1 2 1)/4 along both axes
    double shift = 0;            ///< error of all positions in the still [video px]
    double weight = 1, confidence = 1;
    unsigned seed = 1;
};

/// Random discs, which have edges of all directions. The picture has four times the video's size.
[[nodiscard]] twin::Grey sharpDiscs(unsigned seed, Size video = {256, 192});
/// The video frame that its sensor takes of the picture `sharp`, in whole grey levels.
[[nodiscard]] twin::Grey videoOf(const twin::Grey& sharp, const SensorPair& pair);
/// Calls matched() of the listener with the video frame of `sharp` and with the still `still`.
void showTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
            const SensorPair& pair);
/// Calls replaced() of the listener, as the pipeline does for a still that is about to be replaced.
void showReplacedTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
                    const SensorPair& pair);
[[nodiscard]] MatchedPictures matchedPictures(const twin::Grey& sharp, const twin::Grey& still,
                                              const SensorPair& pair);
[[nodiscard]] inline MatchedPictures matchedPictures(const twin::Grey& sharp,
                                                     const SensorPair& pair) {
    return matchedPictures(sharp, sharp, pair);
}

/// Mean squared error of a video that is enlarged with these filters [grey levels^2]; null: with
/// Keys' cubic.
[[nodiscard]] double enlargingError(const twin::Grey& sharp, const SensorPair& pair,
                                    const FilterBank* bank);

}  // namespace mfar
