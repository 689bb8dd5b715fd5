#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// Rule by which the earlier frame (keyframe) is chosen that depth is measured against.
enum class KeyframeRule {
    Fixed,  ///< the frame `distance` frames ago
    Angle,  ///< the newest frame with a parallax of at least `angle`
    Score,  ///< the frame with the least expected error, see Keyframes::choose()
};

struct KeyframeOptions {
    KeyframeRule rule = KeyframeRule::Score;
    int frames = 12;            ///< number of frames kept; [2, 64]
    int distance = 6;           ///< for Fixed [frames]; [1, frames)
    double angle = 0.035;       ///< for Angle: least parallax [rad]
    double leastAngle = 0.005;  ///< least parallax with which depth is measured at all [rad]
    double leastOverlap = 0.6;  ///< least share of a part that the keyframe must show; [0, 1]
};

struct DepthOptions {
    KeyframeOptions keyframes{};
    EpipolarOptions search{};
    /// No keyframe is searched where the relative standard deviation of inverse depth is at most
    /// this; [0.001, 1].
    double enough = 0.01;
};

/// The source of a frame's depth.
enum class DepthSource { None, Carried, Still, Keyframe, Both };

/// Throws std::invalid_argument, which names the first option that is out of range.
void validate(const KeyframeOptions& options);
void validate(const DepthOptions& options);

}  // namespace mfar
