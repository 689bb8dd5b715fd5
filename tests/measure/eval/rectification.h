#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <optional>

namespace mfar::eval {

/// Two views, rotated so that both have the same pinhole camera. A point at (u, v) in the first
/// view lies at (u - d, v) in the second, with d = fx |baseline| / depth >= 0. u follows the
/// baseline, so a vertical baseline turns the pictures on their side.
class Rectification {
public:
    /// Both views have the lens and size of `camera`. `T_second_first` maps camera coordinates of
    /// the first view to the second. `disparities`: largest disparity d [px]; the rectified
    /// pictures get a margin of this width on the left. Empty if the views cannot be rectified,
    /// because the baseline is zero or points into or near a picture.
    [[nodiscard]] static std::optional<Rectification>
    of(const CameraModel& camera, const RigidTransform& T_second_first, int disparities);

    [[nodiscard]] cv::Size size() const { return size_; }
    /// Maps for cv::remap, CV_32FC2 of size(): pixel of the view for each rectified pixel.
    [[nodiscard]] cv::Mat firstMap() const { return mapOf(firstTurn_); }
    [[nodiscard]] cv::Mat secondMap() const { return mapOf(secondTurn_); }
    /// ofFirst() rectifies a pixel of the first view. toSecond() returns the second view's pixel
    /// for a rectified pixel, or (-1e6, -1e6) if the ray points behind the second camera.
    [[nodiscard]] Eigen::Vector2d ofFirst(const Eigen::Vector2d& pixel) const;
    [[nodiscard]] Eigen::Vector2d toSecond(const Eigen::Vector2d& rectified) const {
        return toView(rectified, secondTurn_);
    }

private:
    Rectification(const CameraModel& camera, const RigidTransform& T_second_first);
    [[nodiscard]] bool fit(int disparities);
    [[nodiscard]] Eigen::Vector2d toView(const Eigen::Vector2d& rectified,
                                         const Eigen::Matrix3d& R_rect_view) const;
    [[nodiscard]] cv::Mat mapOf(const Eigen::Matrix3d& R_rect_view) const;

    CameraModel camera_;
    Eigen::Matrix3d firstTurn_, secondTurn_;
    Eigen::Vector2d centre_;
    cv::Size size_;
};

}  // namespace mfar::eval
