#include "hal/virtual/synthetic_truth.h"

#include "hal/virtual/synthetic_ray.h"

#include <array>
#include <limits>
#include <optional>
#include <thread>

namespace mfar::synthetic {
namespace {

constexpr double kFar = 1e6;  // length of rays [m]; nothing in the world is farther away
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

template <class Row>
void eachRow(int rows, const Row& row) {
    const auto half = [&](int first) {
        for (int y = first; y < rows; y += 2)
            row(y);
    };
    std::jthread other(half, 1);
    half(0);
}

/// Returns the ray through a pixel. Its direction has z = 1 in the camera's frame, so that
/// distances along the ray are depths [m].
Ray pixelRay(const Viewpoint& view, int x, int y) {
    const Eigen::Vector2d ray =
        view.camera.unproject({static_cast<double>(x), static_cast<double>(y)});
    return {view.T_world_camera.translation,
            view.T_world_camera.rotation * Eigen::Vector3d(ray.x(), ray.y(), 1)};
}

std::optional<Eigen::Vector2d> visiblePixel(const Snapshot& solids, const Viewpoint& view,
                                            const RigidTransform& T_camera_world,
                                            const Eigen::Vector3d& point) {
    constexpr double kReach = 1 - 1e-4;
    const Eigen::Vector3d inCamera = T_camera_world * point;
    if (!(inCamera.z() > 1e-6)) return std::nullopt;
    Eigen::Vector2d pixel =
        view.camera.project({inCamera.x() / inCamera.z(), inCamera.y() / inCamera.z()});
    const Size size = view.camera.size;
    if (!(pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= size.width - 0.5 &&
          pixel.y() <= size.height - 0.5))
        return std::nullopt;
    const Eigen::Vector3d& eye = view.T_world_camera.translation;
    if (solids.cast({eye, point - eye}, kReach)) return std::nullopt;
    return pixel;
}

}  // namespace

FloatImage inverseDepth(const World& world, const Viewpoint& view) {
    const Size size = view.camera.size;
    FloatImage out{size, std::vector<float>(static_cast<std::size_t>(size.width) * size.height)};
    const Snapshot solids(world, view.t);
    eachRow(size.height, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            const auto hit = solids.cast(pixelRay(view, x, y), kFar);
            out.at(x, y) = hit ? static_cast<float>(1 / hit->distance) : 0.F;
        }
    });
    return out;
}

FlowImage flowBetween(const World& world, const Viewpoint& from, const Viewpoint& to) {
    const Size size = from.camera.size;
    FlowImage out{size, std::vector<std::array<float, 2>>(static_cast<std::size_t>(size.width) *
                                                          size.height)};
    const Snapshot then(world, from.t), later(world, to.t);
    const RigidTransform T_camera_world = to.T_world_camera.inverse();
    eachRow(size.height, [&](int y) {
        for (int x = 0; x < size.width; ++x) {
            out.at(x, y) = {kUnknown, kUnknown};
            const auto hit = then.cast(pixelRay(from, x, y), kFar);
            if (!hit) continue;
            const auto pixel =
                visiblePixel(later, to, T_camera_world, later.pose(hit->primitive) * hit->local);
            if (!pixel) continue;
            out.at(x, y) = {static_cast<float>(pixel->x() - x), static_cast<float>(pixel->y() - y)};
        }
    });
    return out;
}

}  // namespace mfar::synthetic
