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
/// deviation of inverse depth is the standard deviation of a match [px] divided by the number of
/// pixels by which a match moves per unit of inverse depth.
class DepthMeasurement {
public:
    DepthMeasurement(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthMeasurement(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// Uses `lens` instead of a new EpipolarLens. `lens` must contain the rays of all pixels of
    /// `video`.
    DepthMeasurement(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Measures the pixels of `where`, which must lie in the search's area. The other picture is
    /// the still or a keyframe, in the video's geometry. A pixel becomes unknown if the other
    /// picture does not show its point, because the point is outside it or occluded in it (z-test).
    /// `R_other_video` rotates rays of the video camera into coordinates of the other camera. The
    /// search's unit of length is `unit` metres. `cells` is empty or contains, for every cell of
    /// the video, a more accurate s (see EpipolarLens). The values are interpolated between cells,
    /// and used where they agree with the pixel's own s.
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
    // For each pixel: index of the pixel of the other picture that shows the same point, or -1.
    std::vector<std::int32_t> landing_;
    // s_: the s of each pixel. nearest_: for each pixel of the other picture, the largest s of the
    // points at this pixel. The point with the largest s is the nearest one.
    std::vector<float> s_, nearest_;
};

}  // namespace mfar
