#include "pipeline/render/path_tracer.h"

#include "pipeline/render/lens_rays.h"
#include "pipeline/render/ray_scene.h"
#include "pipeline/render/scene_check.h"
#include "pipeline/render/view_bounds.h"
#include "pipeline/se3.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace mfar {

void validate(const PathTracerOptions& o) {
    const auto require = [](bool sound, const char* name) {
        if (!sound) throw std::invalid_argument(std::string(name) + " is out of its range");
    };
    require(o.maxDepth >= 1 && o.maxDepth <= 64, "maxDepth");
    require(o.rouletteDepth >= 1, "rouletteDepth");
    require(std::isfinite(o.fireflyClamp) && o.fireflyClamp >= 0, "fireflyClamp");
    require(std::isfinite(o.shadowReach) && o.shadowReach >= 1, "shadowReach");
    require(o.buildThreads >= 1 && o.buildThreads <= 64, "buildThreads");
}

struct PathTracer::Parts {
    Parts(std::shared_ptr<const Scene> sceneToTrace, const PathTracerOptions& o)
        : scene(std::move(sceneToTrace)), options(o), objects(o.buildThreads),
          catcher(o.buildThreads) {
        for (std::size_t k = 0; k < scene->objects.size(); ++k)
            for (const Mesh& mesh : scene->objects[k].model->meshes) {
                std::vector<Eigen::Vector3f> world;
                for (const Eigen::Vector3f& p : mesh.positions)
                    world.emplace_back((scene->objects[k].T_world_object *
                                        (scene->objects[k].scale * p.cast<double>()))
                                           .cast<float>());
                objects.add(world, mesh.triangles);
                idOfMesh.push_back(static_cast<std::uint8_t>(k + 1));
            }
        objects.commit();
        catcher.add(scene->catcher.positions, scene->catcher.triangles);
        catcher.commit();
    }

    std::shared_ptr<const Scene> scene;
    PathTracerOptions options;
    RayScene objects, catcher;
    std::vector<std::uint8_t> idOfMesh;
};

PathTracer::PathTracer(std::shared_ptr<const Scene> scene, const PathTracerOptions& options) {
    validate(options);
    if (!scene) throw std::invalid_argument("scene: none");
    validate(*scene);
    parts_ = std::make_unique<const Parts>(std::move(scene), options);
}

PathTracer::~PathTracer() = default;

void PathTracer::trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
                       Film& film) const {
    if (!isSound(view.camera) || !isFinite(view.T_world_camera) ||
        !(film.size() == view.camera.size))
        throw std::invalid_argument("view is not sound or not the film's");
    const Eigen::Matrix3f R_world_camera =
        view.T_world_camera.rotation.toRotationMatrix().cast<float>();
    for (const std::uint32_t pixel : pixels) {
        const auto width = static_cast<std::uint32_t>(view.camera.size.width);
        const Eigen::Vector2d ray =
            view.camera.unproject({pixel % width, pixel / width});  // its centre
        const Ray seen{view.T_world_camera.translation.cast<float>(),
                       R_world_camera * ray.cast<float>().homogeneous()};
        const RayHit hit = parts_->objects.first(seen);
        FilmSample sample;
        if (hit.found()) {
            sample.hit = {hit.t, parts_->idOfMesh[hit.mesh]};
            sample.radiance = Eigen::Vector3f::Constant(0.5F);
        }
        film.setCentre(pixel, sample.hit);
        for (int i = 0; i < samples; ++i)
            film.add(pixel, sample);
    }
}

PixelRect PathTracer::bounds(const RenderView& view) const {
    Eigen::AlignedBox3f box = parts_->objects.box();
    if (box.isEmpty()) return {};
    if (!parts_->catcher.box().isEmpty()) {
        const Eigen::Vector3f reach =
            Eigen::Vector3f::Constant(0.5F * parts_->options.shadowReach * box.diagonal().norm());
        const Eigen::AlignedBox3f near(box.center() - reach, box.center() + reach);
        const Eigen::AlignedBox3f shadow = near.intersection(parts_->catcher.box());
        if (!shadow.isEmpty()) box.extend(shadow);
    }
    return pixelsOfBox(box, view, LensRays(view.camera));
}

}  // namespace mfar
