#pragma once

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/turned_picture.h"

#include <functional>
#include <vector>

namespace mfar {

/// A frame and the still rotated into its orientation, at one level of a pyramid; borrowed.
struct TurnedPair {
    const EpipolarLens& lens;  ///< the frame's
    PixelOffset origin;        ///< camera pixel of the still's first pixel
    const LumaImage& video;
    const LumaImage& still;
    const std::vector<std::uint8_t>& seen;  ///< 1 where the still is valid
};

/// Prior knowledge for matching patches.
struct PatchPrior {
    const CameraModel& camera;  ///< the frame's camera
    const PosePrior& pose;
    double noise;          ///< standard deviation of a pixel, of frame and still [grey levels]
    double pixelsPerUnit;  ///< largest motion of a pixel per unit of s; 0: no parallax
    /// s at a pixel of the frame, correct to within kAlongSlack pixels on the epipolar line.
    std::function<double(const Eigen::Vector2d&)> nearness;
};
inline constexpr int kAlongSlack = 6;

/// Matches the textured patches of a frame with the still. At half size, the search reaches along
/// the epipolar lines by the slack of the nearness and across them by three standard deviations of
/// the prior; then matches are refined at full size. `half` and `full` may be the same level.
[[nodiscard]] std::vector<RayMatch> matchPatches(const TurnedPair& full, const TurnedPair& half,
                                                 const PatchPrior& prior, Workers& workers);

}  // namespace mfar
