#include "tests/measure/eval/flow_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mfar::eval {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
// A point is accepted if its depth in the still's camera exceeds kNearPlane times its depth in the
// frame's camera. Otherwise it is behind or too close to the still's camera.
constexpr double kNearPlane = 1e-3;
constexpr double kSplatWeight = 0.25;  // a point covers pixels with a larger bilinear weight

struct Seen {
    Eigen::Vector2d pixel;  ///< position in the still, resampled to the video's geometry
    double inverseDepth;    ///< [1/m], along the optical axis of the resampled still
};

class Projection {
public:
    Projection(const StereoRig& rig, const RigidTransform& T_still_frame)
        : rig_(rig), turn_(rig.T_still_video.rotation.conjugate()),
          rotation_((turn_ * T_still_frame.rotation).toRotationMatrix()),
          translation_(turn_ * T_still_frame.translation) {}

    [[nodiscard]] std::optional<Seen> see(const Eigen::Vector2d& pixel, double inverseDepth) const {
        const Eigen::Vector2d ray = rig_.video.unproject(pixel);
        const Eigen::Vector3d point =
            rotation_ * Eigen::Vector3d(ray.x(), ray.y(), 1) + inverseDepth * translation_;
        if (!(point.z() > kNearPlane) || !insideStill(point)) return std::nullopt;
        return Seen{rig_.video.project(point.head<2>() / point.z()), inverseDepth / point.z()};
    }

    /// Difference of inverse depth that moves a point by one pixel in the still [1/m].
    [[nodiscard]] double onePixel() const {
        const double length = translation_.norm() * std::max(rig_.video.fx, rig_.video.fy);
        return length > 0 ? 1 / length : std::numeric_limits<double>::infinity();
    }

private:
    [[nodiscard]] bool insideStill(const Eigen::Vector3d& point) const {
        const Eigen::Vector3d p = rig_.T_still_video.rotation * point;
        if (!(p.z() > kNearPlane)) return false;
        const Eigen::Vector2d q = rig_.still.project(p.head<2>() / p.z());
        const Size size = rig_.still.size;
        return q.x() >= -0.5 && q.y() >= -0.5 && q.x() <= size.width - 0.5 &&
               q.y() <= size.height - 0.5;
    }

    const StereoRig& rig_;
    Eigen::Quaterniond turn_;
    Eigen::Matrix3d rotation_;
    Eigen::Vector3d translation_;
};

/// Inverse depth of the nearest surface at each pixel of the still, resampled to the video's
/// geometry.
class NearestSurface {
public:
    explicit NearestSurface(cv::Size size) : inverseDepth_(size, CV_64F, -1.0) {}

    void add(const Seen& seen) {
        const double left = std::floor(seen.pixel.x()), top = std::floor(seen.pixel.y());
        for (const double y : {top, top + 1})
            for (const double x : {left, left + 1}) {
                const double weight =
                    (1 - std::abs(seen.pixel.x() - x)) * (1 - std::abs(seen.pixel.y() - y));
                double* cell = weight > kSplatWeight ? at(x, y) : nullptr;
                if (cell) *cell = std::max(*cell, seen.inverseDepth);
            }
    }

    [[nodiscard]] bool hides(const Seen& seen, double margin) {
        const double* cell = at(std::round(seen.pixel.x()), std::round(seen.pixel.y()));
        return cell && *cell > seen.inverseDepth + margin;
    }

private:
    [[nodiscard]] double* at(double x, double y) {
        if (!(x >= 0 && y >= 0 && x < inverseDepth_.cols && y < inverseDepth_.rows)) return nullptr;
        return inverseDepth_.ptr<double>(static_cast<int>(y)) + static_cast<int>(x);
    }

    cv::Mat inverseDepth_;
};

}  // namespace

cv::Mat flowOfInverseDepth(const FloatImage& inverseDepth, const StereoRig& rig,
                           const RigidTransform& T_still_frame) {
    const Size size = inverseDepth.size;
    CV_Assert(size == rig.video.size);
    const Projection projection(rig, T_still_frame);
    const auto seenAt = [&](int x, int y) -> std::optional<Seen> {
        const double here = inverseDepth.at(x, y);
        return here >= 0 ? projection.see({x, y}, here) : std::nullopt;
    };
    cv::Mat flow(size.height, size.width, CV_32FC2, cv::Scalar(kNan, kNan));
    NearestSurface nearest(flow.size());
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (const auto seen = seenAt(x, y)) nearest.add(*seen);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const auto seen = seenAt(x, y);
            if (!seen || nearest.hides(*seen, projection.onePixel())) continue;
            flow.at<cv::Vec2f>(y, x) = {static_cast<float>(seen->pixel.x() - x),
                                        static_cast<float>(seen->pixel.y() - y)};
        }
    return flow;
}

}  // namespace mfar::eval
