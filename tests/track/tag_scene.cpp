#include "tests/track/tag_scene.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace mfar::test {
namespace {

constexpr int kRays = 4;

struct Drawn {
    RigidTransform T_tag_camera;
    double cell;  ///< side of one cell of the tag [m]
    TagPicture picture;
    PixelRect box;
};

PixelRect boxOf(const CameraModel& camera, const RigidTransform& T_world_camera,
                const PlacedTag& tag, double grow) {
    PlacedTag larger = tag;
    larger.size *= grow;
    PixelRect box{camera.size.width, camera.size.height, 0, 0};
    for (const Eigen::Vector2d& p : cornersOf(camera, T_world_camera, larger)) {
        box.x0 = std::min(box.x0, static_cast<int>(p.x()) - 2);
        box.y0 = std::min(box.y0, static_cast<int>(p.y()) - 2);
        box.x1 = std::max(box.x1, static_cast<int>(p.x()) + 3);
        box.y1 = std::max(box.y1, static_cast<int>(p.y()) + 3);
    }
    return {std::max(box.x0, 0), std::max(box.y0, 0), std::min(box.x1, camera.size.width),
            std::min(box.y1, camera.size.height)};
}

Drawn prepare(const CameraModel& camera, const RigidTransform& T_world_camera,
              const PlacedTag& tag) {
    Drawn out{(T_world_camera.inverse() * tag.T_world_tag).inverse(), 0, drawTag(tag.tag), {}};
    const int inner = out.picture.size - 2 * out.picture.corner;
    out.cell = tag.size / inner;
    out.box = boxOf(camera, T_world_camera, tag, 1.05 * out.picture.size / inner);
    return out;
}

std::optional<int> paperAt(const Drawn& tag, const Eigen::Vector2d& ray) {
    const Eigen::Vector3d direction = tag.T_tag_camera.rotation * ray.homogeneous();
    const Eigen::Vector3d& from = tag.T_tag_camera.translation;
    const double reach = -from.z() / direction.z();
    if (!(reach > 0)) return std::nullopt;
    const Eigen::Vector2d p = (from + reach * direction).head<2>() / tag.cell;
    const double half = tag.picture.size / 2.;
    const auto x = static_cast<int>(std::floor(p.x() + half));
    const auto y = static_cast<int>(std::floor(p.y() + half));
    if (x < 0 || y < 0 || x >= tag.picture.size || y >= tag.picture.size) return std::nullopt;
    return tag.picture.cells[static_cast<std::size_t>(y) * tag.picture.size + x] > 127;
}

double lightAt(const CameraModel& camera, const Drawn& tag, int x, int y, double ground,
               const SensorLook& look) {
    double sum = 0;
    for (int i = 0; i < kRays * kRays; ++i) {
        const int column = i % kRays, row = i / kRays;
        const Eigen::Vector2d pixel(x + (column + 0.5) / kRays - 0.5,
                                    y + (row + 0.5) / kRays - 0.5);
        const auto paper = paperAt(tag, camera.unproject(pixel));
        sum += !paper ? ground : *paper == 1 ? look.bright : look.dark;
    }
    return sum / (kRays * kRays);
}

}  // namespace

std::array<Eigen::Vector2d, 4>
cornersOf(const CameraModel& camera, const RigidTransform& T_world_camera, const PlacedTag& tag) {
    std::array<Eigen::Vector2d, 4> out;
    for (int k = 0; k < 4; ++k) {
        const Eigen::Vector2d c = kTagCorners[k] * tag.size / 2;
        const Eigen::Vector3d p =
            T_world_camera.inverse() * (tag.T_world_tag * Eigen::Vector3d(c.x(), c.y(), 0));
        out[k] = camera.project(p.head<2>() / p.z());
    }
    return out;
}

GrayPicture renderTags(const CameraModel& camera, const RigidTransform& T_world_camera,
                       const std::vector<PlacedTag>& tags, const SensorLook& look) {
    const double ground = 0.35;
    std::vector<double> light(static_cast<std::size_t>(camera.size.width) * camera.size.height,
                              ground);
    for (const PlacedTag& tag : tags) {
        const Drawn drawn = prepare(camera, T_world_camera, tag);
        for (int y = drawn.box.y0; y < drawn.box.y1; ++y)
            for (int x = drawn.box.x0; x < drawn.box.x1; ++x) {
                double& pixel = light[static_cast<std::size_t>(y) * camera.size.width + x];
                pixel = lightAt(camera, drawn, x, y, pixel, look);
            }
    }
    GrayPicture out(camera.size, 0);
    std::mt19937 random(look.seed);
    std::normal_distribution<double> noise(0, 1);
    for (std::size_t i = 0; i < light.size(); ++i) {
        const double grey = 255 * std::pow(light[i], 1 / look.gamma) + look.noise * noise(random);
        out.pixels[i] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
    return out;
}

CameraModel testCamera() {
    return {{640, 480}, 560.4, 560.9, 321.7, 237.6, {-0.115, 0.062, 0.0006, -0.0005, 0.0}};
}

RigidTransform cameraAt(double distance, double pitch, double yaw, double roll) {
    const Eigen::Quaterniond turn = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitX()) *
                                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ());
    return {turn, turn * Eigen::Vector3d(0, 0, -distance)};
}

double angleBetween(const RigidTransform& a, const RigidTransform& b) {
    return a.rotation.angularDistance(b.rotation);
}

}  // namespace mfar::test
