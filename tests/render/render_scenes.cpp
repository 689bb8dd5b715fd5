#include "tests/render/render_scenes.h"

#include "pipeline/render/picture_resolver.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace mfar::render_scenes {

Mesh sphere(const Eigen::Vector3f& centre, float radius, int rings) {
    Mesh out;
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= columns; ++j) {
            const float theta = std::numbers::pi_v<float> * static_cast<float>(i) / rings;
            const float phi = std::numbers::pi_v<float> * static_cast<float>(j) / rings;
            const Eigen::Vector3f n{std::sin(theta) * std::cos(phi),
                                    std::sin(theta) * std::sin(phi), std::cos(theta)};
            out.normals.push_back(n);
            out.positions.emplace_back(centre + radius * n);
        }
    const auto at = [columns](int i, int j) {
        return static_cast<std::uint32_t>(i * (columns + 1) + j);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < columns; ++j) {
            out.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            out.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
    return out;
}

Material lampOf(const Eigen::Vector3f& emission) {
    Material out;
    out.baseColour = {0, 0, 0, 1};
    out.metallic = 0;
    out.emission = emission;
    return out;
}

Mesh square(float side, float z) {
    Mesh out;
    out.positions = {{-side, -side, z}, {side, -side, z}, {side, side, z}, {-side, side, z}};
    out.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    out.triangles = {{0, 1, 2}, {0, 2, 3}};
    return out;
}

ShadowCatcher ground(float side, float albedo) {
    const Mesh mesh = square(side, 0);
    return {mesh.positions, mesh.triangles, Eigen::Vector3f::Constant(albedo)};
}

Model modelOf(Mesh mesh, const Material& material) {
    Model out;
    out.meshes.push_back(std::move(mesh));
    out.materials.push_back(material);
    return out;
}

SceneObject objectOf(Model model) {
    SceneObject out;
    out.model = std::make_shared<const Model>(std::move(model));
    return out;
}

std::shared_ptr<const Environment> evenLight(float radiance) {
    auto out = std::make_shared<Environment>();
    out->size = {8, 4};
    out->radiance.assign(32, Eigen::Vector3f::Constant(radiance));
    return out;
}

std::shared_ptr<const Environment> unevenLight() {
    auto out = std::make_shared<Environment>();
    out->size = {64, 32};
    for (int row = 0; row < 32; ++row)
        for (int column = 0; column < 64; ++column) {
            const float up = 1 - static_cast<float>(row) / 32;
            const bool window = row >= 10 && row < 14 && column >= 20 && column < 26;
            out->radiance.emplace_back(0.2F + up, 0.3F + up, 0.4F + up);
            if (window) out->radiance.back() = {30, 28, 25};
        }
    return out;
}

RenderView lookingAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, Size size,
                     double focal) {
    RenderView out;
    out.camera = {size, focal, focal, (size.width - 1) / 2.0, (size.height - 1) / 2.0, {}};
    const Eigen::Vector3d z = (target - eye).normalized();
    const Eigen::Vector3d up =
        std::abs(z.z()) > 0.999 ? Eigen::Vector3d::UnitY().eval() : Eigen::Vector3d::UnitZ().eval();
    const Eigen::Vector3d x = z.cross(up).normalized();
    Eigen::Matrix3d R_world_camera;
    R_world_camera << x, z.cross(x), z;
    out.T_world_camera = {Eigen::Quaterniond(R_world_camera), eye};
    return out;
}

std::vector<std::uint32_t> allPixels(Size size) {
    std::vector<std::uint32_t> out(static_cast<std::size_t>(size.width) *
                                   static_cast<std::size_t>(size.height));
    std::iota(out.begin(), out.end(), 0U);
    return out;
}

Film traced(const PathTracer& tracer, const RenderView& view, int samples) {
    Film film(view.camera.size);
    tracer.trace(view, allPixels(view.camera.size), samples, film);
    return film;
}

RenderedPicture resolved(const Film& film, const RenderView& view) {
    RenderedPicture out;
    resolve(film, view, {}, out);
    return out;
}

}  // namespace mfar::render_scenes
