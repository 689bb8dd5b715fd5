#pragma once

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/turned_picture.h"

#include <functional>
#include <vector>

namespace mfar {

/// One pyramid level of a frame, and of the still rotated into the frame's orientation. Refers to
/// data that must outlive it.
struct TurnedPair {
    const EpipolarLens& lens;  ///< lens of the frame
    PixelOffset origin;        ///< pixel of the frame's camera at which the still's first pixel
                               ///< lies
    const LumaImage& video;
    const LumaImage& still;
    const std::vector<std::uint8_t>& seen;  ///< 1 where a pixel of the still is valid
};

/// What is known before patches are matched.
struct PatchPrior {
    const CameraModel& camera;  ///< the frame's camera
    const PosePrior& pose;
    double noise;          ///< standard deviation of the noise of a pixel, in frame and still [grey
                           ///< levels]
    double pixelsPerUnit;  ///< largest motion of a pixel per unit of s; 0: no parallax
    /// Returns s at a pixel of the frame. Its error is at most kAlongSlack pixels along the
    /// epipolar line.
    std::function<double(const Eigen::Vector2d&)> nearness;
};
inline constexpr int kAlongSlack = 6;

/// Matches the textured patches of a frame with the still. First they are searched at half size:
/// along the epipolar lines within the error of `nearness`, and across them within three standard
/// deviations of the prior pose. Then the matches are refined at full size. `half` and `full` may
/// be the same pyramid level.
[[nodiscard]] std::vector<RayMatch> matchPatches(const TurnedPair& full, const TurnedPair& half,
                                                 const PatchPrior& prior, Workers& workers);

}  // namespace mfar
