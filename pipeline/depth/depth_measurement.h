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

/// Inverse depth of the scene from one epipolar search, and its variance: the standard deviation of
/// a match, divided by how far a unit of inverse depth moves it.
class DepthMeasurement {
public:
    DepthMeasurement(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthMeasurement(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// As above, sharing the camera's rays.
    DepthMeasurement(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Measures the pixels of `where`, which must lie in the search's area. Pixels that the other
    /// picture does not show become unknown: those outside of it, and those behind other points
    /// that land on the same place (z-test). `R_other_video` rotates rays into the other picture at
    /// the video's geometry; `unit`: the search's unit of length [m]. `cells`: s of every cell of
    /// 4x4 pixels from a finer alignment, used where it agrees with the pixel's own; may be empty.
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
    std::vector<std::int32_t> landing_;  // pixel of the other picture, or -1
    std::vector<float> s_, nearest_;     // nearest_: s of the nearest point that lands on the pixel
};

}  // namespace mfar
