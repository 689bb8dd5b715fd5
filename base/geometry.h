#pragma once

#include "base/image_view.h"
#include "base/time.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <optional>

namespace mfar {

/// Pixels x0 <= x < x1, y0 <= y < y1.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
    bool operator==(const PixelRect&) const = default;
};

/// The smallest rectangle that contains both; an empty one is ignored.
[[nodiscard]] inline PixelRect around(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// The intersection, which may be empty.
[[nodiscard]] inline PixelRect common(const PixelRect& a, const PixelRect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// The rectangle widened by `margin` on each side and clipped to the picture.
[[nodiscard]] inline PixelRect widened(const PixelRect& r, int margin, Size picture) {
    return common({r.x0 - margin, r.y0 - margin, r.x1 + margin, r.y1 + margin},
                  {0, 0, picture.width, picture.height});
}

/// Pinhole camera with radial-tangential distortion (Brown-Conrady, OpenCV's order k1 k2 p1 p2 k3).
/// Pixel centres at integers. Camera frame: x right, y down, z forward.
struct CameraModel {
    Size size;                           ///< [px]
    double fx = 0, fy = 0;               ///< focal lengths [px]
    double cx = 0, cy = 0;               ///< principal point [px]
    std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3

    /// Normalised ray (x/z, y/z) to pixel.
    [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector2d& ray) const;
    /// Derivative of project() by the ray [px].
    [[nodiscard]] Eigen::Matrix2d projectJacobian(const Eigen::Vector2d& ray) const;
    /// Pixel to normalised ray; Newton iterations undo the distortion. Far outside the lens's valid
    /// circle, where the model folds over, the result is the ray of the nearest valid radius.
    [[nodiscard]] Eigen::Vector2d unproject(const Eigen::Vector2d& pixel) const;
    /// As above, but faster where the ray of a near pixel is known, such as its neighbour's.
    [[nodiscard]] Eigen::Vector2d unproject(const Eigen::Vector2d& pixel,
                                            const Eigen::Vector2d& close) const;
    /// The same lens in front of a sensor of another resolution: c -> (c + 0.5) s - 0.5.
    [[nodiscard]] CameraModel scaledTo(Size to) const;
};

/// T_a_b: maps coordinates in frame b to frame a. Metres.
struct RigidTransform {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();

    [[nodiscard]] RigidTransform inverse() const {
        const Eigen::Quaterniond r = rotation.conjugate();
        return {r, -(r * translation)};
    }
    [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
        return rotation * p + translation;
    }
    [[nodiscard]] RigidTransform operator*(const RigidTransform& b) const {
        return {(rotation * b.rotation).normalized(), rotation * b.translation + translation};
    }
};

/// The two sensors of the board and their relative pose.
struct StereoRig {
    CameraModel video;
    CameraModel still;
    RigidTransform T_still_video;  ///< video camera coordinates -> still camera coordinates
};

/// The video camera's pose. `T_world_video` maps video camera coordinates to world (tag map).
struct Pose {
    Timestamp time;
    RigidTransform T_world_video;
    /// Covariance of a small motion in the video camera's own frame, T_world_video * exp(rotation
    /// [rad], translation [m]). Zero: the pose counts as exact, as recorded poses do.
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    int tags = 0;  ///< number of tags it was measured from; 0: predicted or recorded
    double reprojectionError = 0;  ///< root mean square over the tags' corners [px]
};

}  // namespace mfar
