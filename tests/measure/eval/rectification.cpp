#include "tests/measure/eval/rectification.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mfar::eval {
namespace {

constexpr double kShortest = 1e-9;  // shorter baselines count as zero [m]
constexpr double kFlattest = 0.2;   // smallest cosine between a ray and the rectified optical axis
constexpr double kLargest = 3;      // largest ratio of a rectified side to the view's width

Eigen::Vector3d rayOf(const CameraModel& camera, const Eigen::Vector2d& pixel) {
    return camera.unproject(pixel).homogeneous();
}

template <class Visit>
void eachBorderPixel(Size size, const Visit& visit) {
    for (int x = 0; x < size.width; ++x)
        for (const int y : {0, size.height - 1})
            visit(Eigen::Vector2d(x, y));
    for (int y = 0; y < size.height; ++y)
        for (const int x : {0, size.width - 1})
            visit(Eigen::Vector2d(x, y));
}

}  // namespace

Rectification::Rectification(const CameraModel& camera, const RigidTransform& T_second_first)
    : camera_(camera), firstTurn_(Eigen::Matrix3d::Zero()), secondTurn_(Eigen::Matrix3d::Zero()),
      centre_(camera.cx, camera.cy) {
    const RigidTransform T_first_second = T_second_first.inverse();
    const Eigen::Vector3d along = T_first_second.translation.normalized();
    const Eigen::Vector3d axis =
        Eigen::Vector3d::UnitZ() + T_first_second.rotation * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d forward = (axis - along * along.dot(axis)).normalized();
    firstTurn_ << along.transpose(), forward.cross(along).transpose(), forward.transpose();
    secondTurn_ = firstTurn_ * T_first_second.rotation.toRotationMatrix();
}

std::optional<Rectification> Rectification::of(const CameraModel& camera,
                                               const RigidTransform& T_second_first,
                                               int disparities) {
    if (!(T_second_first.translation.norm() > kShortest)) return std::nullopt;
    Rectification out(camera, T_second_first);
    if (!out.fit(disparities)) return std::nullopt;
    return out;
}

bool Rectification::fit(int disparities) {
    constexpr double kMax = std::numeric_limits<double>::max();
    Eigen::Vector2d low(kMax, kMax), high = -low;
    bool flat = false;
    eachBorderPixel(camera_.size, [&](const Eigen::Vector2d& pixel) {
        const Eigen::Vector3d ray = rayOf(camera_, pixel).normalized();
        flat =
            flat || !((firstTurn_ * ray).z() > kFlattest) || !((secondTurn_ * ray).z() > kFlattest);
        const Eigen::Vector2d place = ofFirst(pixel);
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    });
    if (flat || !((high.x() - low.x()) < kLargest * camera_.size.width) ||
        !((high.y() - low.y()) < kLargest * camera_.size.width))
        return false;
    // `left` and `top` are whole pixels, so views that are already rectified are not interpolated.
    // The margin of 1e-6 keeps rounding errors from adding a row or column.
    const double left = std::floor(low.x() + 1e-6) - disparities, top = std::floor(low.y() + 1e-6);
    size_ = {static_cast<int>(std::ceil(high.x() - 1e-6) - left) + 1,
             static_cast<int>(std::ceil(high.y() - 1e-6) - top) + 1};
    centre_ -= Eigen::Vector2d(left, top);
    return true;
}

Eigen::Vector2d Rectification::ofFirst(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d ray = firstTurn_ * rayOf(camera_, pixel);
    return camera_.fx * ray.head<2>() / ray.z() + centre_;
}

Eigen::Vector2d Rectification::toView(const Eigen::Vector2d& rectified,
                                      const Eigen::Matrix3d& R_rect_view) const {
    const Eigen::Vector3d ray =
        R_rect_view.transpose() * ((rectified - centre_) / camera_.fx).homogeneous();
    if (!(ray.z() > 1e-6)) return {-1e6, -1e6};
    return camera_.project(ray.head<2>() / ray.z());
}

cv::Mat Rectification::mapOf(const Eigen::Matrix3d& R_rect_view) const {
    cv::Mat map(size_, CV_32FC2);
    for (int v = 0; v < map.rows; ++v)
        for (int u = 0; u < map.cols; ++u) {
            const Eigen::Vector2d pixel = toView({u, v}, R_rect_view);
            map.at<cv::Vec2f>(v, u) = {static_cast<float>(pixel.x()),
                                       static_cast<float>(pixel.y())};
        }
    return map;
}

}  // namespace mfar::eval
