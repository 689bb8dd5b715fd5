#include "tests/flow/flow_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mfar::test {
namespace {

double latticeValue(int x, int y, int z) {
    auto h = static_cast<std::uint32_t>(x) * 0x8DA6B343U ^
             static_cast<std::uint32_t>(y) * 0xD8163841U ^
             static_cast<std::uint32_t>(z) * 0xCB1AB31FU;
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12)) * 0x297A2D39U;
    return (h ^ (h >> 15)) / 2147483648.0 - 1;
}

double valueNoise(const Eigen::Vector3d& p) {
    const Eigen::Vector3d low = p.array().floor();
    const Eigen::Vector3d f = p - low;
    const Eigen::Vector3d u = f.array().square() * (3 - 2 * f.array());
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        const int i = c & 1, j = c >> 1 & 1, k = c >> 2;
        sum += (i != 0 ? u.x() : 1 - u.x()) * (j != 0 ? u.y() : 1 - u.y()) *
               (k != 0 ? u.z() : 1 - u.z()) *
               latticeValue(static_cast<int>(low.x()) + i, static_cast<int>(low.y()) + j,
                            static_cast<int>(low.z()) + k);
    }
    return sum;
}

double texture(const Eigen::Vector3d& p, double grain) {
    return 0.6 * valueNoise(grain * p) + 0.3 * valueNoise(0.43 * grain * p) +
           0.3 * valueNoise(0.17 * grain * p);
}

}  // namespace

double Scene::depth(const RigidTransform& T_camera_video, const Eigen::Vector2d& ray) const {
    const RigidTransform T_video_camera = T_camera_video.inverse();
    const Eigen::Vector3d direction = T_video_camera.rotation * ray.homogeneous();
    const Eigen::Vector3d& from = T_video_camera.translation;
    double nearest = 0;
    for (const Surface& s : surfaces) {
        const double z = (s.distance - s.normal.dot(from)) / s.normal.dot(direction);
        const Eigen::Vector3d hit = from + z * direction;
        if (!(z > 1e-3 * std::abs(s.distance)) || (nearest > 0 && z > nearest)) continue;
        if ((hit.head<2>().array() >= s.least.array()).all() &&
            (hit.head<2>().array() <= s.greatest.array()).all())
            nearest = z;
    }
    return nearest;
}

LumaImage Scene::render(const CameraModel& camera, const RigidTransform& T_camera_video) const {
    LumaImage out(camera.size);
    const RigidTransform T_video_camera = T_camera_video.inverse();
    for (int y = 0; y < camera.size.height; ++y) {
        for (int x = 0; x < camera.size.width; ++x) {
            double sum = 0;
            for (int sample = 0; sample < 4; ++sample) {
                const Eigen::Vector2d pixel(x - 0.25 + 0.5 * (sample & 1),
                                            y - 0.25 + 0.5 * (sample >> 1));
                const Eigen::Vector2d ray = camera.unproject(pixel);
                const double z = depth(T_camera_video, ray);
                sum += z > 0 ? texture(T_video_camera * (z * ray.homogeneous()), grain) : -1;
            }
            out.row(y)[x] = static_cast<std::uint8_t>(
                std::clamp(std::lround(128 + 0.25 * contrast * sum), 0L, 255L));
        }
    }
    return out;
}

CameraModel oddPlain() {
    return {{161, 119}, 150, 148, 79.2, 60.7, {}};
}

CameraModel oddBarrel() {
    return {{161, 119}, 120, 121, 82.5, 57.1, {-0.31, 0.08, 0.002, -0.0015, 0.004}};
}

EpipolarSearch searchWith(const CameraModel& camera, int threads) {
    return {{camera, camera, {}}, std::make_shared<Workers>(threads)};
}

Eigen::Vector2d landing(const EpipolarSearch& search, const View& view, int x, int y) {
    const CameraModel& camera = view.camera;
    const double s = search.s()[static_cast<std::size_t>(y) * camera.size.width + x];
    const Eigen::Vector2d r = camera.unproject({x, y});
    const Eigen::Vector3d t = search.translation().cast<double>();
    const Eigen::Vector2d moved = r + s * (t.head<2>() - r * t.z());
    return camera.project((search.pose().rotation * moved.homogeneous()).hnormalized());
}

FlowErrors errorsOf(const EpipolarSearch& search, const View& view) {
    const CameraModel& camera = view.camera;
    std::vector<double> errors;
    for (int y = 0; y < camera.size.height; ++y) {
        for (int x = 0; x < camera.size.width; ++x) {
            const Eigen::Vector2d ray = camera.unproject({x, y});
            const Eigen::Vector3d p =
                view.T_still_video * (view.scene.depth({}, ray) * ray.homogeneous());
            if (!(p.z() > 0) || p.head<2>().norm() > 2 * p.z()) continue;
            const Eigen::Vector2d truth = camera.project(p.hnormalized());
            const bool shown = truth.x() > 2 && truth.y() > 2 &&
                               truth.x() < camera.size.width - 3 &&
                               truth.y() < camera.size.height - 3;
            const double front = view.scene.depth(view.T_still_video, p.hnormalized());
            if (!shown || front < 0.99 * p.z()) continue;
            errors.push_back((landing(search, view, x, y) - truth).norm());
        }
    }
    FlowErrors out{.pixels = errors.size(), .median = 0, .bad = 0};
    if (errors.empty()) return out;
    std::sort(errors.begin(), errors.end());
    out.median = errors[errors.size() / 2];
    const auto bad = errors.end() - std::upper_bound(errors.begin(), errors.end(), 1.0);
    out.bad = static_cast<double>(bad) / static_cast<double>(errors.size());
    return out;
}

bool isFinite(const EpipolarSearch& search) {
    return std::all_of(search.s().begin(), search.s().end(),
                       [](float s) { return std::isfinite(s); });
}

RigidTransform motion(const Eigen::Vector3d& degrees, const Eigen::Vector3d& t) {
    const Eigen::Vector3d a = degrees * std::numbers::pi / 180;
    return {Eigen::Quaterniond(Eigen::AngleAxisd(a.z(), Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(a.y(), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(a.x(), Eigen::Vector3d::UnitX())),
            t};
}

}  // namespace mfar::test
