#include "tests/render/still_life.h"

#include "tests/render/render_scenes.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace mfar::render_scenes {
namespace {

Material materialOf(const Eigen::Vector3f& colour, float metallic, float roughness) {
    Material out;
    out.baseColour.head<3>() = colour;
    out.metallic = metallic;
    out.roughness = roughness;
    return out;
}

Mesh box(const Eigen::Vector3f& edges) {
    Mesh out;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5F, 0.5F}) {
            Eigen::Vector3f n = Eigen::Vector3f::Zero(), u = n, v = n;
            n[axis] = side;
            u[(axis + 1) % 3] = side;  // the sign of `side` makes all faces point outwards
            v[(axis + 2) % 3] = 0.5F;
            const auto first = static_cast<std::uint32_t>(out.positions.size());
            for (const auto& [along, across] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                const Eigen::Vector3f corner =
                    n + static_cast<float>(along) * u + static_cast<float>(across) * v;
                out.positions.emplace_back(corner.cwiseProduct(edges));
            }
            out.triangles.push_back({first, first + 1, first + 2});
            out.triangles.push_back({first, first + 2, first + 3});
        }
    return out;
}

SceneObject placed(Mesh mesh, const Material& material, const Eigen::Vector3d& at, double turn) {
    SceneObject out = objectOf(modelOf(std::move(mesh), material));
    out.T_world_object = {Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ())),
                          at};
    return out;
}

}  // namespace

std::shared_ptr<const Scene> stillLife() {
    auto scene = std::make_shared<Scene>();
    scene->objects = {placed(sphere({0, 0, 0}, 0.08F, 24), materialOf({0.8F, 0.15F, 0.1F}, 0, 0.6F),
                             {0, 0, 0.08}, 0),
                      placed(sphere({0, 0, 0}, 0.05F, 24), materialOf({0.9F, 0.8F, 0.5F}, 1, 0.15F),
                             {0.12, 0.09, 0.05}, 0),
                      placed(box({0.1F, 0.1F, 0.12F}), materialOf({0.2F, 0.4F, 0.7F}, 0, 0.4F),
                             {-0.13, 0.05, 0.06}, 0.5),
                      placed(box({0.12F, 0.06F, 0.03F}), materialOf({0.3F, 0.6F, 0.25F}, 0, 0.9F),
                             {0.03, -0.14, 0.015}, -0.3)};
    scene->lighting.environment = unevenLight();
    scene->lighting.sun.emplace();
    scene->lighting.sun->towards.normalize();
    scene->lighting.sun->irradiance = {2, 1.9F, 1.7F};
    scene->catcher = ground(1, 0.6F);
    return scene;
}

std::shared_ptr<const Scene> stillLifeLitBy(const Eigen::Vector3f& radiance) {
    auto environment = std::make_shared<Environment>();
    environment->size = {8, 4};
    environment->radiance.assign(32, radiance);
    auto out = std::make_shared<Scene>(*stillLife());
    out->lighting = {environment, {}};
    return out;
}

RenderView viewFrom(Size size, double azimuth, double elevation, double distance) {
    const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
    const Eigen::Vector3d direction{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a),
                                    std::sin(e)};
    return lookingAt(distance * direction, {0, 0, 0}, size, size.width);
}

}  // namespace mfar::render_scenes
