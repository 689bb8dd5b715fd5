#pragma once

#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/epipolar/relative_pose.h"
#include "pipeline/epipolar/turned_picture.h"

#include <functional>
#include <vector>

namespace mfar {

/// One pyramid level of a frame and of the still rotated into the frame's orientation. Refers to
/// data that must outlive it.
struct TurnedPair {
    const EpipolarLens& lens;
    PixelOffset origin;  ///< pixel of the frame at the first pixel of `still`
    const LumaImage& video;
    const LumaImage& still;
    const std::vector<std::uint8_t>& seen;  ///< 1 for valid pixels of the still
};

struct PatchPrior {
    const CameraModel& camera;
    const PosePrior& pose;
    /// Standard deviation of a pixel's noise in frame and still [grey levels].
    double noise;
    double pixelsPerUnit;  ///< largest motion of a pixel per unit of s; 0: no parallax
    /// Returns s at a pixel of the frame, with an error of at most kAlongSlack pixels along the
    /// epipolar line.
    std::function<double(const Eigen::Vector2d&)> sAt;
};
inline constexpr int kAlongSlack = 6;

/// Matches the textured patches of a frame with the still. At half size, they are searched along
/// the epipolar lines within the error of s and across them within three standard deviations of the
/// prior pose. The matches are refined at full size. `half` and `full` may be the same pyramid
/// level.
[[nodiscard]] std::vector<RayMatch> matchPatches(const TurnedPair& full, const TurnedPair& half,
                                                 const PatchPrior& prior, Workers& workers);

}  // namespace mfar
