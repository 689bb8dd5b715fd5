#include "pipeline/track/search_regions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mfar {
namespace {

constexpr double kRoom = 10;         // margin for errors that the prediction does not model [px]
constexpr double kQuietZone = 0.3;   // margin for the tag's white border [tag sizes]
constexpr double kMostRoom = 80;     // upper limit of a usable prediction's uncertainty [px]
constexpr double kSmallestTag = 10;  // smallest extent of a searched tag [px]

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

/// Returns how uncertain the position of a point in the picture is: three standard deviations [px].
/// `distance` is the point's distance from the camera.
double uncertainty(const Matrix6& covariance, double distance, const CameraModel& camera) {
    const double turn = covariance.diagonal().head<3>().maxCoeff();
    const double move = covariance.diagonal().tail<3>().maxCoeff() / (distance * distance);
    return 3 * std::max(camera.fx, camera.fy) * std::sqrt(std::max(turn + move, 0.));
}

bool inside(const Eigen::Vector2d& p, Size size) {
    return p.x() >= 0 && p.y() >= 0 && p.x() < size.width && p.y() < size.height;
}

std::optional<PixelRect> regionOf(const MappedTag& tag, const CameraModel& camera,
                                  const RigidTransform& T_camera_world, const Matrix6& covariance) {
    const RigidTransform T_camera_tag = T_camera_world * tag.T_world_tag;
    const Eigen::Vector3d& middle = T_camera_tag.translation;
    const Eigen::Vector3d normal = T_camera_tag.rotation * Eigen::Vector3d::UnitZ();
    if (!(middle.z() > 0.05 * middle.norm()) || !(normal.dot(middle) > 0)) return std::nullopt;
    if (!inside(camera.project(middle.head<2>() / middle.z()), camera.size)) return std::nullopt;
    Eigen::Vector2d least = Eigen::Vector2d::Constant(1e9), most = -least;
    for (const Eigen::Vector2d& corner : kTagCorners) {
        const Eigen::Vector3d p =
            T_camera_tag * Eigen::Vector3d(corner.x() * tag.size / 2, corner.y() * tag.size / 2, 0);
        if (!(p.z() > 0.05 * p.norm())) return std::nullopt;
        const Eigen::Vector2d pixel = camera.project(p.head<2>() / p.z());
        least = least.cwiseMin(pixel);
        most = most.cwiseMax(pixel);
    }
    const double extent = (most - least).maxCoeff();
    if (!(extent >= kSmallestTag)) return std::nullopt;
    const double unsure = uncertainty(covariance, middle.norm(), camera);
    if (!(unsure <= kMostRoom)) return PixelRect{0, 0, camera.size.width, camera.size.height};
    const double room = kRoom + kQuietZone * extent + unsure;
    const Eigen::Vector2d limit(camera.size.width, camera.size.height);
    least = (least.array() - room).matrix().cwiseMax(0).cwiseMin(limit);
    most = (most.array() + room).matrix().cwiseMax(0).cwiseMin(limit);
    return PixelRect{static_cast<int>(least.x()), static_cast<int>(least.y()),
                     static_cast<int>(std::ceil(most.x())), static_cast<int>(std::ceil(most.y()))};
}

}  // namespace

std::vector<PixelRect> searchRegions(const TagMap& map, const CameraModel& camera,
                                     const RigidTransform& T_world_camera,
                                     const Matrix6& covariance) {
    const RigidTransform T_camera_world = T_world_camera.inverse();
    std::vector<PixelRect> out;
    for (const auto& [key, tag] : map.tags()) {
        std::optional<PixelRect> region = regionOf(tag, camera, T_camera_world, covariance);
        if (!region) continue;
        // Merges the region with all regions that overlap it. After each merge, the loop begins
        // again, because the merged region may overlap regions that the original did not.
        for (auto it = out.begin(); it != out.end();) {
            if (!overlap(*it, *region)) {
                ++it;
                continue;
            }
            region = around(*it, *region);
            out.erase(it);
            it = out.begin();
        }
        out.push_back(*region);
    }
    return out;
}

double areaOf(const std::vector<PixelRect>& regions) {
    double sum = 0;
    for (const PixelRect& r : regions)
        sum += static_cast<double>(r.area());
    return sum;
}

}  // namespace mfar
