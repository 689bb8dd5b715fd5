#pragma once

#include "base/geometry.h"
#include "base/workers.h"
#include "pipeline/flow/luma_image.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace mfar {

/// Whole pixels.
struct PixelOffset {
    int x = 0, y = 0;
};

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
    static constexpr int kAlign = 8;

    /// Fills the canvas from the source's picture, bilinear. `seen`: 1 where the picture is, 0
    /// elsewhere.
    void draw(const LumaImage& picture, Workers& workers, LumaImage& out,
              std::vector<std::uint8_t>& seen) const;

private:
    struct Source {
        float x, y;  // far outside where the picture cannot be
    };
    void mapGrid(const CameraModel& camera, const CameraModel& source,
                 const Eigen::Matrix3d& R_source_camera);

    Size size_;
    PixelOffset origin_;
    int gridWidth_ = 0;
    std::vector<Source> grid_;  // picture pixel of every kAlign-th canvas pixel
};

}  // namespace mfar
