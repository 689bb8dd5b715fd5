#pragma once

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/turned_picture.h"

#include <functional>
#include <vector>

namespace mfar {

/// A frame and the still in its orientation at one level of a pyramid; borrowed.
struct TurnedPair {
    const EpipolarLens& lens;  ///< of the frame
    PixelOffset origin;        ///< camera pixel of the still's first
    const LumaImage& video;
    const LumaImage& still;
    const std::vector<std::uint8_t>& seen;  ///< 1 where the still is
};

/// What is known where patches are to be matched.
struct PatchPrior {
    const CameraModel& camera;  ///< of the frame
    const PosePrior& pose;
    double noise;          ///< standard deviation of a frame's or the still's pixel [grey levels]
    double pixelsPerUnit;  ///< longest way of a pixel per unit of s, EpipolarLens; 0: no parallax
    /// s at a pixel of the frame, right to within kAlongSlack pixels of its way.
    std::function<double(const Eigen::Vector2d&)> nearness;
};
inline constexpr int kAlongSlack = 6;

/// The textured patches of a frame that the still shows: sought at half size along their epipolar
/// lines by the slack of the nearness and across them by three standard deviations of the prior,
/// then placed at full size. `half` and `full` may be the same level.
[[nodiscard]] std::vector<RayMatch> matchPatches(const TurnedPair& full, const TurnedPair& half,
                                                 const PatchPrior& prior, Workers& workers);

}  // namespace mfar
