#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <vector>

namespace mfar {

/// What CameraModel::unproject() gives, from a table every few pixels: within 0.05 px of it inside
/// the picture for lenses that do not fold there (0.01 px at 60 degrees).
class LensRays {
public:
    explicit LensRays(const CameraModel& camera);

    [[nodiscard]] const CameraModel& camera() const { return camera_; }
    /// Normalised ray (x/z, y/z) of a point of the picture [px], up to a pixel outside it.
    [[nodiscard]] Eigen::Vector2f at(float x, float y) const;
    /// The least rectangle of whole table cells with all pixels whose ray is in the box.
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
/// Numbers finite, focal lengths above 0, between 1 and 16384 pixels a side.
[[nodiscard]] bool isSound(const CameraModel& camera);

}  // namespace mfar
