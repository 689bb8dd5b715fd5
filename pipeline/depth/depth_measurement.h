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

/// What one epipolar search says of the scene's depth, with how well it can know: the standard
/// deviation of a match through the way that a unit of inverse depth moves it.
class DepthMeasurement {
public:
    DepthMeasurement(const CameraModel& video, std::shared_ptr<Workers> workers)
        : DepthMeasurement(video, EpipolarLens(video, 0), std::move(workers)) {}
    /// The same with the camera's rays, which others have already.
    DepthMeasurement(const CameraModel& video, EpipolarLens lens, std::shared_ptr<Workers> workers);

    /// Into the pixels of `where`; unknown for what the other picture does not show: outside of it,
    /// or behind what lands on the same place there (z-test). `where` lies in the search's area.
    /// `R_other_video` turns rays into the other picture at the video's geometry; `unit`: the
    /// search's unit of length [m]. `cells`: s of every cell of 4x4 pixels from a finer alignment,
    /// taken where it agrees with the pixel's own; empty: none.
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
    std::vector<float> s_, nearest_;     // s of what lands there first
};

}  // namespace mfar
