#include "tests/warp/cast_scene.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace mfar::test {
namespace {

using Eigen::Vector3d;
using Rgba = Eigen::Vector4d;

// In the camera's frame, `along` has z = 1. So the point from + t * along has the depth t.
struct Ray {
    Vector3d from, along;
};
struct Met {
    double z;
    int id;
    Vector3d point;
};

std::optional<double> meet(const Ray& ray, const CastScene::Ball& ball) {
    const Vector3d c = ray.from - ball.centre;
    const double a = ray.along.squaredNorm(), b = c.dot(ray.along) / a;
    const double root = b * b - (c.squaredNorm() - ball.radius * ball.radius) / a;
    if (!(root > 0)) return {};
    const double t = -b - std::sqrt(root);
    return t > 0.01 ? std::optional(t) : std::nullopt;
}

double shade(const CastScene& scene, const Vector3d& p) {
    double light = 1;
    for (const CastScene::Ball& ball : scene.balls) {
        const double r = (p.head<2>() - ball.centre.head<2>()).norm() / (1.6 * ball.radius);
        light *= 1 - 0.8 * std::pow(std::max(0.0, 1 - r * r), 2);
    }
    return 1 - light;
}

std::optional<Met> firstMet(const CastScene& scene, const Ray& ray) {
    std::optional<Met> met;
    for (std::size_t i = 0; i < scene.balls.size(); ++i)
        if (const auto t = meet(ray, scene.balls[i]); t && (!met || *t < met->z))
            met = Met{*t, static_cast<int>(i) + 1, ray.from + *t * ray.along};
    if (met || !scene.shadows) return met;
    const double t = -ray.from.z() / ray.along.z();
    if (!(t > 0.01 && t < 100)) return {};
    const Vector3d p = ray.from + t * ray.along;
    return shade(scene, p) > 0 ? std::optional(Met{t, kCatcherId, p}) : std::nullopt;
}

Rgba colourOf(const CastScene& scene, const Met& met) {
    if (met.id == kCatcherId) return {0, 0, 0, shade(scene, met.point)};
    const Vector3d p = 30 * met.point;
    const double k = scene.contrast;
    return {0.5 + 0.2 * k * std::sin(p.x() + 2 * met.id) + 0.15 * k * std::sin(2.3 * p.y()),
            0.5 + 0.3 * k * std::sin(1.7 * p.z() - p.x()), 0.45 + 0.3 * k * std::sin(p.y() - p.z()),
            1};
}

Model ballModel(double radius, int segments) {
    Model model;
    Mesh mesh;
    const int rows = segments / 2;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= segments; ++i) {
            const double a = 2 * std::numbers::pi * i / segments, b = std::numbers::pi * j / rows;
            mesh.positions.push_back((radius * Vector3d(std::sin(b) * std::cos(a),
                                                        std::sin(b) * std::sin(a), std::cos(b)))
                                         .cast<float>());
        }
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < segments; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (segments + 1) + i);
            const auto below = a + static_cast<std::uint32_t>(segments) + 1;
            mesh.triangles.push_back({a, below, a + 1});
            mesh.triangles.push_back({a + 1, below, below + 1});
        }
    model.meshes.push_back(std::move(mesh));
    model.materials.emplace_back();
    return model;
}

void castPixel(const CastScene& scene, const RenderView& view, int grid, std::uint32_t pixel,
               RenderedPicture& out) {
    const auto width = static_cast<std::uint32_t>(view.camera.size.width);
    const Eigen::Vector2d at(pixel % width, pixel / width);
    const auto ray = [&](const Eigen::Vector2d& p) -> Ray {
        return {view.T_world_camera.translation,
                view.T_world_camera.rotation * view.camera.unproject(p).homogeneous()};
    };
    Rgba sum = Rgba::Zero();
    auto shown = firstMet(scene, ray(at));
    const bool centre = shown.has_value();
    for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
            const Eigen::Vector2d offset(i, j);
            const auto met =
                firstMet(scene, ray(at + ((offset.array() + 0.5) / grid - 0.5).matrix()));
            if (!met) continue;
            sum += colourOf(scene, *met);
            if (!centre && (!shown || met->z < shown->z)) shown = met;
        }
    for (int c = 0; c < 4; ++c)
        out.colour[pixel][c] = static_cast<std::uint8_t>(
            std::lround(255 * std::clamp(sum[c] / (grid * grid), 0.0, 1.0)));
    if (shown) {
        out.depth[pixel] = static_cast<float>(shown->z);
        out.id[pixel] = static_cast<std::uint8_t>(shown->id);
    }
}

RenderedPicture emptyPicture(const RenderView& view) {
    const auto pixels = static_cast<std::size_t>(view.camera.size.width) * view.camera.size.height;
    RenderedPicture out;
    out.camera = view.camera;
    out.T_world_camera = view.T_world_camera;
    out.colour.resize(pixels);
    out.depth.resize(pixels);
    out.id.resize(pixels);
    return out;
}

}  // namespace

mfar::Scene CastScene::scene(int segments) const {
    Scene out;
    for (const Ball& ball : balls)
        out.objects.push_back({std::make_shared<Model>(ballModel(ball.radius, segments)),
                               {Eigen::Quaterniond::Identity(), ball.centre},
                               1});
    if (shadows) {
        out.catcher.positions = {
            {-0.6F, -0.6F, 0}, {0.6F, -0.6F, 0}, {0.6F, 0.6F, 0}, {-0.6F, 0.6F, 0}};
        out.catcher.triangles = {{0, 1, 2}, {0, 2, 3}};
    }
    return out;
}

RenderedPicture CastScene::castPixels(const RenderView& view, int grid,
                                      std::span<const std::uint32_t> pixels) const {
    RenderedPicture out = emptyPicture(view);
    for (const std::uint32_t pixel : pixels)
        castPixel(*this, view, grid, pixel, out);
    return out;
}

RenderedPicture CastScene::cast(const RenderView& view, int grid) const {
    RenderedPicture out = emptyPicture(view);
    for (std::uint32_t pixel = 0; pixel < out.id.size(); ++pixel)
        castPixel(*this, view, grid, pixel, out);
    return out;
}

CastScene twoBalls() {
    return {{{{0, 0, 0.1}, 0.09}, {{0.09, -0.09, 0.05}, 0.045}}};
}

CameraModel bentCamera(Size size) {
    const double f = size.width;
    return {
        size, f, 1.01 * f, 0.48 * size.width, 0.52 * size.height, {-0.2, 0.05, 0.001, -0.001, 0}};
}

RigidTransform orbit(double degrees, double distance, double upDegrees) {
    const double a = degrees * std::numbers::pi / 180, up = upDegrees * std::numbers::pi / 180;
    const Vector3d middle(0.02, -0.02, 0.07);
    const Vector3d back(std::cos(up) * std::sin(a), -std::cos(up) * std::cos(a), std::sin(up));
    const Vector3d z = -back, x = z.cross(Vector3d::UnitZ()).normalized(), y = z.cross(x);
    Eigen::Matrix3d R;
    R << x, y, z;
    return {Eigen::Quaterniond(R).normalized(), middle + distance * back};
}

}  // namespace mfar::test
