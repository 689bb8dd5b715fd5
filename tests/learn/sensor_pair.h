#pragma once

#include "base/geometry.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/match_listener.h"
#include "tests/oracle/enlarge.h"

#include <cstdint>
#include <vector>

namespace mfar {

struct SensorPair {
    /// Blur of the video: number of passes of (1 2 1)/4 along both axes.
    int videoBlur = 0;
    /// Standard deviations of the noise [grey levels].
    double videoNoise = 0;
    double stillNoise = 0;
    double gain = 1, gamma = 1;  ///< exposure and tone curve of the still
    /// True: a video pixel is the root of the mean square of what it sees. False: it is the mean.
    bool averagesLight = false;
    /// Blur of the still: number of passes of (1 2 1)/4 along both axes.
    int stillBlur = 0;
    double shift = 0;  ///< error in x of all matched positions in the still [video px]
    double weight = 1, confidence = 1;  ///< of all matches
    unsigned seed = 1;
};

inline constexpr Size kDiscsVideo{256, 192}, kDiscsStill{1024, 768};

/// Random discs, with edges in all directions. The sides of the picture are four times as long as
/// those of the video.
[[nodiscard]] twin::Grey sharpDiscs(unsigned seed, Size video = kDiscsVideo);
/// Returns the frame that the video sensor takes of `sharp`, in whole grey levels.
[[nodiscard]] twin::Grey videoOf(const twin::Grey& sharp, const SensorPair& pair);
/// Sensors of kDiscsVideo and kDiscsStill at the same place, without lens distortion.
[[nodiscard]] StereoRig discsRig();
[[nodiscard]] std::vector<std::uint8_t> bytesOf(const twin::Grey& picture);
/// Calls listener.matched() with the frame that the video sensor takes of `sharp`, and with the
/// picture that the still sensor takes of `still`.
void showTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
            const SensorPair& pair);
/// Calls listener.replaced(), as the pipeline does before it replaces a still.
void showReplacedTo(MatchListener& listener, const twin::Grey& sharp, const twin::Grey& still,
                    const SensorPair& pair);
[[nodiscard]] MatchedPictures matchedPictures(const twin::Grey& sharp, const twin::Grey& still,
                                              const SensorPair& pair);
[[nodiscard]] inline MatchedPictures matchedPictures(const twin::Grey& sharp,
                                                     const SensorPair& pair) {
    return matchedPictures(sharp, sharp, pair);
}

/// Mean squared error of the video after enlarging with the filters of `bank` [grey levels^2],
/// without a border of 32 px. If `bank` is null, Keys' cubic enlarges the video.
[[nodiscard]] double enlargingError(const twin::Grey& sharp, const SensorPair& pair,
                                    const FilterBank* bank);

}  // namespace mfar
