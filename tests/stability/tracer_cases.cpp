#include "pipeline/render/film.h"
#include "pipeline/render/path_tracer.h"
#include "tests/render/render_scenes.h"
#include "tests/stability/cases.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

namespace mfar::stress {
namespace {

using Eigen::Vector3f;

Vector3f pointOf(Context& c, double reach) {
    const auto along = [&] {
        if (c.hostile.chance(0.02)) return c.hostile.pick({0.0, 1e-30, 1e12 * reach});
        return reach * c.hostile.real(-1, 1);
    };
    const double x = along(), y = along(), z = along();
    return Eigen::Vector3d(x, y, z).cast<float>();
}

/// Random triangles. Some have no area, some share corners, and some have all corners in one point.
Mesh meshOf(Context& c, double reach) {
    if (c.hostile.chance(0.3))
        return render_scenes::sphere(pointOf(c, 0.3 * reach), static_cast<float>(0.5 * reach), 12);
    Mesh out;
    const int points = c.hostile.integer(1, 60);
    for (int i = 0; i < points; ++i)
        out.positions.push_back(i > 0 && c.hostile.chance(0.1) ? out.positions.front()
                                                               : pointOf(c, reach));
    if (c.hostile.chance(0.5))
        for (int i = 0; i < points; ++i)
            out.normals.push_back(c.hostile.chance(0.05) ? Vector3f(0, 0, 0)
                                                         : c.hostile.direction().cast<float>());
    const auto corner = [&] {
        return static_cast<std::uint32_t>(c.hostile.integer(0, points - 1));
    };
    for (int i = c.hostile.integer(0, 100); i > 0; --i)
        out.triangles.push_back({corner(), corner(), corner()});
    return out;
}

Material materialOf(Context& c) {
    Material out;
    const auto share = [&] { return static_cast<float>(c.hostile.pick({0.0, 1.0, 1e-4, 0.3})); };
    out.baseColour = {share(), share(), share(), 1};
    out.metallic = share();
    out.roughness = share();
    if (c.hostile.chance(0.2)) out.emission = Vector3f::Constant(c.hostile.pick({1.0F, 1e6F}));
    out.doubleSided = c.hostile.chance(0.7);
    return out;
}

std::shared_ptr<const Environment> lightOf(Context& c) {
    auto out = std::make_shared<Environment>();
    out->size = {c.hostile.integer(1, 32), c.hostile.integer(1, 16)};
    const double most = c.hostile.pick({0.0, 1e-20, 1.0, 1e6});
    for (long i = pixelsOf(out->size); i > 0; --i) {
        const double peak = c.hostile.chance(0.02) ? 1e4 : 1;
        out->radiance.push_back(
            Vector3f::Constant(static_cast<float>(most * peak * c.hostile.real(0, 1))));
    }
    return out;
}

std::shared_ptr<Scene> sceneOf(Context& c) {
    auto out = std::make_shared<Scene>();
    const double reach = c.hostile.pick({1.0, 1.0, 1e-4, 1e4});
    for (int i = c.hostile.integer(0, 3); i > 0; --i) {
        out->objects.push_back(
            render_scenes::objectOf(render_scenes::modelOf(meshOf(c, reach), materialOf(c))));
        SceneObject& object = out->objects.back();
        object.scale = static_cast<float>(1 / reach) * c.hostile.pick({1.0F, 1.0F, 1e-3F, 1e3F});
        object.T_world_object = c.hostile.gentle();
    }
    if (c.hostile.chance(0.7)) out->catcher = render_scenes::ground(3, 0.6F);
    if (c.hostile.chance(0.8)) out->lighting.environment = lightOf(c);
    if (c.hostile.chance(0.6))
        out->lighting.sun = Sun{c.hostile.direction().cast<float>().normalized(),
                                Vector3f::Constant(c.hostile.pick({0.0F, 1.0F, 1e6F})),
                                c.hostile.pick({1e-4F, 0.02F, 1.5F})};
    return out;
}

void spoilScene(Context& c, Scene& scene) {
    auto mesh = std::make_shared<Model>(render_scenes::modelOf(meshOf(c, 1), materialOf(c)));
    mesh->meshes[0].positions[0][c.hostile.integer(0, 2)] = std::nanf("");
    scene.objects.push_back({mesh, {}, 1});
}

void checkFilm(Context& c, const Film& film, const RenderView& view) {
    const RenderedPicture picture = render_scenes::resolved(film, view);
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
        c.checks.within(picture.depth[i], 0, 3.4e38, "depth of a traced pixel");
        c.checks.within(film.error(i), 0, 3.4e38, "error of a traced pixel");
        const Film::Means means = film.means(i);
        for (const Vector3f& mean : {means.object, means.with, means.without})
            c.checks.require(mean.allFinite() && mean.minCoeff() >= 0,
                             "a mean radiance is negative or not finite");
    }
    c.checks.require(film.dropped() == 0, "samples with an invalid radiance were dropped");
}

bool refuses(const std::shared_ptr<const Scene>& scene) {
    try {
        const PathTracer tracer(scene);
        return false;
    } catch (const std::invalid_argument&) {
        return true;
    }
}

void hostileTracer(Context& c) {
    const std::shared_ptr<Scene> scene = sceneOf(c);
    if (c.hostile.chance(0.1)) {
        spoilScene(c, *scene);
        c.checks.require(refuses(scene), "an invalid scene was accepted");
        return;
    }
    PathTracerOptions options;
    options.seed = static_cast<std::uint32_t>(c.hostile.integer(0, 1 << 30));
    options.maxDepth = c.hostile.pick({1, 3, 6, 64});
    const PathTracer tracer(scene, options);
    const CameraModel camera = c.hostile.camera(c.size(1, 40));
    const double away = c.hostile.pick({3.0, 0.3, 1e-3, 100.0});
    const Eigen::Vector3d eye = away * c.hostile.direction();
    const RenderView view{camera,
                          render_scenes::lookingAt(eye, {0, 0, 0}, {8, 8}, 8).T_world_camera};
    constexpr int kSamples = 3;
    const Film film = render_scenes::traced(tracer, view, kSamples);
    checkFilm(c, film, view);
    c.checks.through("PathTracer", kSamples * pixelsOf(camera.size));
    if (c.scale == Scale::Product) return;
    // Every pixel must be the same if the work is divided differently.
    Film other(camera.size);
    std::vector<std::uint32_t> pixels = render_scenes::allPixels(camera.size);
    const auto half = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.size() / 2);
    tracer.trace(view, {half, pixels.end()}, kSamples, other);
    for (int i = 0; i < kSamples; ++i)
        tracer.trace(view, {pixels.begin(), half}, 1, other);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Film::Means a = film.means(i), b = other.means(i);
        c.checks.require(a.object == b.object && a.with == b.with,
                         "a pixel differs if the work is divided into several calls");
    }
}

}  // namespace

std::vector<Case> tracerCases() {
    return {{"tracer", hostileTracer, true}};
}

}  // namespace mfar::stress
