#pragma once

#include "pipeline/depth/inverse_depth_field.h"
#include "pipeline/epipolar/epipolar_search.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace mfar {

/// Measures the inverse depth of the scene and its variance from one epipolar search. The standard
/// deviation of inverse depth is that of a match [px], divided by how far a unit of inverse depth
/// moves the match [px].
class DepthMeasurement {
public:
    DepthMeasurement(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthMeasurement(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// Uses `lens` (with the rays of all its pixels) instead of computing an EpipolarLens from
    /// `video`.
    DepthMeasurement(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Measures the pixels of `where`, which must lie in the search's area. The other picture is
    /// the still or an earlier frame, in the video's geometry. Pixels that it does not show become
    /// unknown: their points lie outside of it, or behind other points that land on the same pixel
    /// (z-test). `R_other_video` rotates rays of the video camera into the coordinates of the other
    /// camera. `unit`: the search's unit of length [m]. `cells`: s of every cell of 4x4 pixels from
    /// a finer alignment, used where it agrees with the pixel's own s; may be empty.
    void run(const EpipolarSearch& search, const Eigen::Matrix3f& R_other_video, double unit,
             std::span<const float> cells, const PixelRect& where, InverseDepthField& out);

private:
    void takeField(const EpipolarSearch& search, std::span<const float> cells,
                   const PixelRect& where);
    void land(const EpipolarSearch& search, const Eigen::Matrix3f& R, const PixelRect& where);
    void findNearest(const PixelRect& where);

    EpipolarLens lens_;
    float focal_;
    std::shared_ptr<Workers> workers_;
    std::vector<std::int32_t> landing_;  // per pixel: index of the other picture's pixel that shows
                                         // its point, or -1
    std::vector<float> s_, nearest_;     // nearest_: per pixel of the other picture, s of the
                                         // nearest point that lands there
};

}  // namespace mfar
