#pragma once

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/turned_picture.h"

#include <functional>
#include <vector>

namespace mfar {

/// One pyramid level of a frame and of the still. The still is rotated into the frame's
/// orientation. The members refer to data that must outlive this object.
struct TurnedPair {
    const EpipolarLens& lens;
    PixelOffset origin;  ///< position of the first pixel of `still` in the frame [px]
    const LumaImage& video;
    const LumaImage& still;
    const std::vector<std::uint8_t>& seen;  ///< 1 for valid pixels of the still
};

struct PatchPrior {
    const CameraModel& camera;
    const PosePrior& pose;
    /// Standard deviation of a pixel's noise [grey levels], the larger one of frame and still.
    double noise;
    double pixelsPerUnit;  ///< largest motion of a pixel per unit of s [px]; 0: no parallax
    /// Returns s at a pixel of the frame, so accurate that the pixel's place in the still is wrong
    /// by at most kAlongSlack px along the epipolar line.
    std::function<double(const Eigen::Vector2d&)> sAt;
};
inline constexpr int kAlongSlack = 6;

/// Matches the textured patches of a frame with the still. Each patch is first searched in `half`,
/// around the place that its s and the prior pose predict. Along the epipolar line, the search goes
/// as far as the error of s requires; across the line, it covers three standard deviations of the
/// prior pose, but at least 1 px and at most 8 px of `half`. Near the epipole, it covers three
/// standard deviations along the line, too, within the same limits. Then the match is refined in
/// `full`. `half` is usually half as large as `full`; both may be the same pyramid level.
[[nodiscard]] std::vector<RayMatch> matchPatches(const TurnedPair& full, const TurnedPair& half,
                                                 const PatchPrior& prior, Workers& workers);

}  // namespace mfar
