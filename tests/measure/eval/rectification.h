#pragma once

#include "base/geometry.h"

#include <opencv2/core.hpp>

#include <optional>

namespace mfar::eval {

/// Two views turned so that their pictures are one pinhole camera beside itself: a point at (u, v)
/// in the first lies at (u - d, v) in the second, d = fx |baseline| / depth >= 0. The picture may
/// lie on its side: u follows the baseline.
class Rectification {
public:
    /// Both views have the lens and size of `camera`; `T_second_first` maps camera coordinates.
    /// `disparities` [px] of room on the left, where the second view shows what the first has at
    /// its border. Nothing where the pictures cannot be rectified: no baseline, or its direction in
    /// or near one of the pictures.
    [[nodiscard]] static std::optional<Rectification>
    of(const CameraModel& camera, const RigidTransform& T_second_first, int disparities);

    [[nodiscard]] cv::Size size() const { return size_; }
    /// For cv::remap, CV_32FC2 of size(): pixel of the view that each rectified pixel shows.
    [[nodiscard]] cv::Mat firstMap() const { return mapOf(firstTurn_); }
    [[nodiscard]] cv::Mat secondMap() const { return mapOf(secondTurn_); }
    /// Rectified pixel of a pixel of the first view; pixel of the second view that a rectified
    /// pixel shows, far outside when it is behind that camera.
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
    Eigen::Matrix3d firstTurn_, secondTurn_;  ///< R_rect_first, R_rect_second
    Eigen::Vector2d centre_;                  ///< principal point of the rectified pictures [px]
    cv::Size size_;
};

}  // namespace mfar::eval
