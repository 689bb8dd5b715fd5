#pragma once

#include "base/image_view.h"
#include "base/time.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

namespace mfar {

/// The pixels with x0 <= x < x1 and y0 <= y < y1.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    [[nodiscard]] bool empty() const { return x0 >= x1 || y0 >= y1; }
    [[nodiscard]] std::int64_t area() const {
        return empty() ? 0 : std::int64_t{x1 - x0} * std::int64_t{y1 - y0};
    }
    bool operator==(const PixelRect&) const = default;
};

[[nodiscard]] inline PixelRect around(const PixelRect& a, const PixelRect& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

[[nodiscard]] inline PixelRect common(const PixelRect& a, const PixelRect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// Returns the rectangle, widened by `margin` [px] on each side and clipped to the picture.
[[nodiscard]] inline PixelRect widened(const PixelRect& r, int margin, Size picture) {
    return common({r.x0 - margin, r.y0 - margin, r.x1 + margin, r.y1 + margin},
                  {0, 0, picture.width, picture.height});
}

/// A pinhole camera with radial-tangential distortion (Brown-Conrady; coefficients in OpenCV's
/// order k1 k2 p1 p2 k3). Pixel centres have integer coordinates. Camera frame: x right, y down, z
/// forward.
struct CameraModel {
    Size size;
    /// Focal lengths and principal point in pixels.
    double fx = 0, fy = 0;
    double cx = 0, cy = 0;
    std::array<double, 5> distortion{};

    /// Returns the pixel coordinates [px] of a normalised ray (x/z, y/z).
    [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector2d& ray) const;
    /// Returns the derivative of project() with respect to the ray [px].
    [[nodiscard]] Eigen::Matrix2d projectJacobian(const Eigen::Vector2d& ray) const;
    /// Returns the normalised ray (x/z, y/z) of a pixel. Newton iterations invert the distortion.
    /// They end early where the lens model is about to fold over, because several rays map to one
    /// pixel there. In this case, the result is the ray reached so far.
    [[nodiscard]] Eigen::Vector2d unproject(const Eigen::Vector2d& pixel) const;
    /// Returns unproject(pixel), but faster. `close` is the known ray of a nearby pixel.
    [[nodiscard]] Eigen::Vector2d unproject(const Eigen::Vector2d& pixel,
                                            const Eigen::Vector2d& close) const;
    /// Returns the model of the same lens for another resolution. A pixel coordinate c becomes
    /// (c + 0.5) s - 0.5, where s is the new width or height divided by the old one.
    [[nodiscard]] CameraModel scaledTo(Size to) const;
    bool operator==(const CameraModel&) const = default;
};

/// A rotation and a translation [m]. T_a_b converts coordinates in frame b to coordinates in
/// frame a.
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
    bool operator==(const RigidTransform&) const = default;
};

/// The lens models of both cameras and the transform between them.
struct StereoRig {
    CameraModel video;
    CameraModel still;
    RigidTransform T_still_video;
};

/// The pose of the video camera in the world frame. The tag map defines the world frame.
struct Pose {
    Timestamp time;
    RigidTransform T_world_video;
    /// Covariance of a small error x = (rotation [rad], translation [m]) in the video camera's
    /// frame: the true pose is T_world_video * exp(x). Zero means that the pose is exact, e.g.
    /// because it comes from a recording.
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    int tags = 0;                  ///< number of tags used; 0: predicted, interpolated or recorded
    double reprojectionError = 0;  ///< RMS error of the tags' corners [px]
    /// Number of the world frame. Without a tag map, one tag defines the world frame. If another
    /// tag takes its place, the number changes. The motion between poses in different world frames
    /// is unknown.
    int world = 0;
};

}  // namespace mfar
