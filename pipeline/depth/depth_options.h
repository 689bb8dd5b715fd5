#pragma once

#include "pipeline/flow/flow_options.h"

namespace mfar {

/// How the earlier frame is chosen that depth is measured against.
enum class KeyframeRule {
    Fixed,  ///< the frame `distance` frames ago
    Angle,  ///< the newest from which the scene is seen at `angle` at least
    Score,  ///< the one that promises the least error, see Keyframes::choose()
};

struct KeyframeOptions {
    KeyframeRule rule = KeyframeRule::Score;
    int frames = 12;            ///< kept; [2, 64]
    int distance = 6;           ///< Fixed [frames]; [1, frames)
    double angle = 0.035;       ///< Angle [rad]
    double leastAngle = 0.005;  ///< with less parallax depth is not measured at all [rad]
    double leastOverlap = 0.6;  ///< of both pictures, for the scene's distance; [0, 1]
};

struct DepthOptions {
    KeyframeOptions keyframes{};
    EpipolarOptions search{};
    /// Standard deviation of inverse depth, as a share of it, from which on no keyframe is searched
    /// against any more; [0.001, 1].
    double enough = 0.01;
};

/// Where a frame's depth came from.
enum class DepthSource { None, Carried, Still, Keyframe, Both };

/// Throw std::invalid_argument that names the first option out of its range.
void validate(const KeyframeOptions& options);
void validate(const DepthOptions& options);

}  // namespace mfar
