#pragma once

#include "base/geometry.h"

#include <Eigen/Core>

#include <vector>

namespace mfar {

/// A fast approximation of CameraModel::unproject(). It interpolates in a table. The error inside
/// the picture is below 0.05 px if the lens model is one-to-one there (0.01 px at a field of view
/// of 60 degrees).
class LensRays {
public:
    explicit LensRays(const CameraModel& camera);

    [[nodiscard]] const CameraModel& camera() const { return camera_; }
    /// Normalised ray (x/z, y/z) of the pixel position (x, y). The position may be up to 1 px
    /// outside the picture.
    [[nodiscard]] Eigen::Vector2f at(float x, float y) const;
    /// Returns a rectangle that contains all pixels whose rays (x/z, y/z) lie between `least` and
    /// `most`. It consists of whole table cells, clipped to the picture.
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

/// True if all numbers are finite, the focal lengths are above 0, and the size is 1 to 16384 pixels
/// per side.
[[nodiscard]] bool isSound(const CameraModel& camera);

}  // namespace mfar
