#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// Rule for choosing the keyframe: the earlier frame with which the current frame is matched to
/// measure depth.
enum class KeyframeRule {
    Fixed,  ///< the frame `distance` frames ago
    Angle,  ///< the newest frame with a parallax of at least `angle`
    Score,  ///< the frame for which the smallest error is expected, see Keyframes::choose()
};

struct KeyframeOptions {
    KeyframeRule rule = KeyframeRule::Score;
    int frames = 12;            ///< number of earlier frames that are kept; [2, 64]
    int distance = 6;           ///< for KeyframeRule::Fixed: age of the keyframe [frames];
                                ///< [1, frames)
    double angle = 0.035;       ///< for KeyframeRule::Angle: smallest parallax between keyframe and
                                ///< frame [rad]; (0, 1]
    double leastAngle = 0.005;  ///< smallest parallax with which depth is measured at all [rad];
                                ///< (0, 1]
    double leastOverlap = 0.6;  ///< smallest share of a part of the picture that the keyframe must
                                ///< show; [0, 1]
};

struct DepthOptions {
    KeyframeOptions keyframes{};
    EpipolarOptions search{};
    /// Depth is not measured with a keyframe where the relative standard deviation of inverse depth
    /// is at most this; [0.001, 1].
    double enough = 0.01;
};

/// Where the depth of a frame comes from: nowhere, only from earlier frames (Carried), or from
/// matching with the still, with a keyframe, or with both.
enum class DepthSource { None, Carried, Still, Keyframe, Both };

/// Throw std::invalid_argument if an option is out of range. The message names the first such
/// option.
void validate(const KeyframeOptions& options);
void validate(const DepthOptions& options);

}  // namespace mfar
