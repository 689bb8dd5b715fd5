#pragma once

#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/match_listener.h"
#include "tests/oracle/upscale.h"

namespace mfar {

/// How two sensors see the same scene, and how well they are matched.
struct SensorPair {
    int videoBlur = 0;      ///< times that the video is blurred by 1 2 1, each way
    double videoNoise = 0;  ///< standard deviations [grey levels]
    double stillNoise = 0;
    double gain = 1, gamma = 1;  ///< of the still
    int stillBlur = 0;           ///< as of the video, on the still's pixels
    double shift = 0;            ///< by which look-ups are off [video px]
    double weight = 1, confidence = 1;
    unsigned seed = 1;
};

/// Random discs, which have edges of all directions, in a picture of four times the video's size.
[[nodiscard]] twin::Grey sharpDiscs(unsigned seed, Size video = {256, 192});
/// What the video's sensor makes of it, in whole grey levels.
[[nodiscard]] twin::Grey videoOf(const twin::Grey& sharp, const SensorPair& pair);
/// Gives a listener both, where the still shows `still`.
void showTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
            const SensorPair& pair);
/// The same of a still that is about to be replaced.
void showReplacedTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
                    const SensorPair& pair);
[[nodiscard]] MatchedPictures matchedPictures(const twin::Grey& sharp, const twin::Grey& still,
                                              const SensorPair& pair);
[[nodiscard]] inline MatchedPictures matchedPictures(const twin::Grey& sharp,
                                                     const SensorPair& pair) {
    return matchedPictures(sharp, sharp, pair);
}

/// Mean square of what is wrong with a video that these filters enlarge, or Keys' cubic without
/// any [grey levels^2].
[[nodiscard]] double enlargingError(const twin::Grey& sharp, const SensorPair& pair,
                                    const FilterBank* bank);

}  // namespace mfar
