#pragma once

#include "base/geometry.h"
#include "base/workers.h"
#include "pipeline/epipolar/ray_lattice.h"
#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace mfar {

/// A picture as another camera would show it from the same optical centre, on a canvas that may lie
/// beside that camera's own picture.
class TurnedPicture {
public:
    /// The canvas that holds what `camera` would see of a picture that `source` took, no farther
    /// outside the camera's own frame than `beyond` times its width. `R_source_camera` turns rays.
    /// Size 0x0 when that is nothing.
    void place(const CameraModel& camera, const CameraModel& source,
               const Eigen::Matrix3d& R_source_camera, double beyond);

    [[nodiscard]] Size size() const { return size_; }
    /// Camera pixel of canvas pixel (0, 0); both coordinates are multiples of kAlign.
    [[nodiscard]] PixelOffset origin() const { return origin_; }
    static constexpr int kAlign = RayLattice::kStep;

    /// Fills the canvas from the source's picture, bilinear. `seen`: 1 where the picture is, 0
    /// elsewhere.
    void draw(const LumaImage& picture, Workers& workers, LumaImage& out,
              std::vector<std::uint8_t>& seen) const;

private:
    /// What a pair of cameras has in common with the pair of the last frame.
    struct Cameras {
        CameraModel camera, source;
        double rim = 0, sourceRim = 0;         ///< radius of the rays that they can show
        std::vector<Eigen::Vector2d> outline;  ///< rays of the source's border
    };
    void know(const CameraModel& camera, const CameraModel& source);
    [[nodiscard]] Eigen::AlignedBox2d boundsOf(const Eigen::Matrix3d& R_source_camera,
                                               const Eigen::AlignedBox2d& whole) const;
    void mapGrid(const Eigen::Matrix3d& R_source_camera);

    Size size_;
    PixelOffset origin_;
    Cameras known_;
    RayLattice lattice_;
    int gridWidth_ = 0;
    std::vector<float> gridX_, gridY_;  // picture pixel of every kAlign-th canvas pixel
};

}  // namespace mfar
