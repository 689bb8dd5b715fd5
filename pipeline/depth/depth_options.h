#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// How the earlier frame that depth is measured against is chosen.
enum class KeyframeRule {
    Fixed,  ///< the frame `distance` frames ago
    Angle,  ///< the newest with a parallax of at least `angle`
    Score,  ///< the one with the least expected error, see Keyframes::choose()
};

struct KeyframeOptions {
    KeyframeRule rule = KeyframeRule::Score;
    int frames = 12;            ///< number of frames kept; [2, 64]
    int distance = 6;           ///< for Fixed [frames]; [1, frames)
    double angle = 0.035;       ///< for Angle [rad]
    double leastAngle = 0.005;  ///< lower limit of the parallax for any measurement [rad]
    double leastOverlap = 0.6;  ///< lower limit of the share that both pictures show; [0, 1]
};

struct DepthOptions {
    KeyframeOptions keyframes{};
    EpipolarOptions search{};
    /// Relative standard deviation of inverse depth up to which no keyframe is searched any more;
    /// [0.001, 1].
    double enough = 0.01;
};

/// The source of a frame's depth.
enum class DepthSource { None, Carried, Still, Keyframe, Both };

/// Throws std::invalid_argument that names the first option out of its range.
void validate(const KeyframeOptions& options);
void validate(const DepthOptions& options);

}  // namespace mfar
