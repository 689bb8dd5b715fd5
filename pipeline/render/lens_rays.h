#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <vector>

namespace mfar {

/// CameraModel::unproject() from a table with a node every few pixels. Error inside the picture:
/// below 0.05 px for lenses that do not fold there (0.01 px at 60 degrees).
class LensRays {
public:
    explicit LensRays(const CameraModel& camera);

    [[nodiscard]] const CameraModel& camera() const { return camera_; }
    /// Normalised ray (x/z, y/z) of a point of the picture [px], which may be up to a pixel
    /// outside.
    [[nodiscard]] Eigen::Vector2f at(float x, float y) const;
    /// The smallest rectangle of whole table cells that contains all pixels whose ray is in the
    /// box.
    [[nodiscard]] PixelRect pixelsIn(const Eigen::Vector2f& least,
                                     const Eigen::Vector2f& most) const;

private:
    [[nodiscard]] const Eigen::Vector2f& node(int column, int row) const {
        return nodes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(column)];
    }

    CameraModel camera_;
    int columns_ = 0, rows_ = 0;
    std::vector<Eigen::Vector2f> nodes_;
};

/// Whether two cameras give the same rays.
[[nodiscard]] bool sameLens(const CameraModel& a, const CameraModel& b);
/// Whether the numbers are finite, the focal lengths above 0, and the size from 1 to 16384 pixels a
/// side.
[[nodiscard]] bool isSound(const CameraModel& camera);

}  // namespace mfar
