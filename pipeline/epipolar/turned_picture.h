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

/// Resamples a picture (the source) as another camera with the same optical centre would show it.
/// The resampled picture is called the canvas. It can extend beyond the other camera's own picture.
class TurnedPicture {
public:
    /// Sets the position and the size of the canvas. The picture of `camera` is extended on each
    /// side by `beyond` times its width. The canvas is a rectangle around the part of this extended
    /// picture that shows the source's picture. If there is no such part, its size is 0x0.
    /// `R_source_camera` rotates rays from `camera` to `source`. The picture of `camera` is that of
    /// `whole` or a part of it.
    void place(const CameraModel& camera, const CameraModel& whole, const CameraModel& source,
               const Eigen::Matrix3d& R_source_camera, double beyond);

    [[nodiscard]] Size size() const { return size_; }
    /// The pixel of `camera` at canvas pixel (0, 0). Its coordinates are multiples of kAlign.
    [[nodiscard]] PixelOffset origin() const { return origin_; }
    static constexpr int kAlign = RayLattice::kStep;

    /// Resamples the source's `picture` bilinearly into the canvas `out`. `seen` is 1 for canvas
    /// pixels that `picture` covers, else 0.
    void draw(const LumaImage& picture, Workers& workers, LumaImage& out,
              std::vector<std::uint8_t>& seen) const;

private:
    /// The cameras, and values that depend only on these. The values are computed again when a
    /// camera changes.
    struct Cameras {
        CameraModel camera, whole, source;
        double rim = 0, sourceRim = 0;
        std::vector<Eigen::Vector2d> outline;
    };
    void know(const CameraModel& camera, const CameraModel& whole, const CameraModel& source);
    [[nodiscard]] Eigen::AlignedBox2d boundsOf(const Eigen::Matrix3d& R_source_camera,
                                               const Eigen::AlignedBox2d& whole) const;
    void mapGrid(const Eigen::Matrix3d& R_source_camera);

    Size size_;
    PixelOffset origin_;
    Cameras known_;
    RayLattice lattice_;
    int gridWidth_ = 0;
    // For every kAlign-th canvas pixel along each axis: its position in the source's picture [px].
    std::vector<float> gridX_, gridY_;
};

}  // namespace mfar
