#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// Rule that chooses the keyframe, an earlier frame with which the new frame is matched to measure
/// depth. Fixed: the newest frame that is at least `distance` frames old. Angle: the newest frame
/// with a parallax of at least `angle`. Score: the frame with the smallest expected error, see
/// Keyframes::choose().
enum class KeyframeRule {
    Fixed,
    Angle,
    Score,
};

struct KeyframeOptions {
    KeyframeRule rule = KeyframeRule::Score;
    int frames = 12;  ///< number of stored frames, [2, 64]
    /// Smallest age of the keyframe for KeyframeRule::Fixed, as a number of frames. It is at least
    /// 1 and less than the option `frames`.
    int distance = 6;
    /// Smallest parallax between keyframe and frame for KeyframeRule::Angle [rad], (0, 1].
    double angle = 0.035;
    double leastAngle = 0.005;  ///< smallest parallax for measuring depth [rad], (0, 1]
    /// A keyframe is used for a part of the picture only if it shows at least this share of the
    /// part, [0, 1].
    double leastOverlap = 0.6;
};

struct DepthOptions {
    KeyframeOptions keyframes{};
    EpipolarOptions search{};
    /// A part of the picture needs no keyframe if the median relative standard deviation of its
    /// known inverse depths is at most this, [0.001, 1].
    double enough = 0.01;
};

/// Where a frame's depth comes from. None: no depth is known in the measured rectangle, or the
/// median of its relative standard deviation is at least 1. Carried: earlier frames only. Still,
/// Keyframe, Both: a match of the frame with the still, with a keyframe, or with both.
enum class DepthSource { None, Carried, Still, Keyframe, Both };

/// These functions throw std::invalid_argument if an option is out of range. The message names the
/// first such option.
void validate(const KeyframeOptions& options);
void validate(const DepthOptions& options);

}  // namespace mfar
