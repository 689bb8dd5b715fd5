#include "pipeline/render/path_tracer.h"

#include "base/luminance.h"
#include "base/se3.h"
#include "pipeline/render/lens_rays.h"
#include "pipeline/render/path_integrator.h"
#include "pipeline/render/pixel_surface.h"
#include "pipeline/render/scene_check.h"
#include "pipeline/render/traced_scene.h"
#include "pipeline/render/view_bounds.h"
#include "pipeline/scene/glow.h"
#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace mfar {
namespace {

constexpr std::size_t kBatch = 64;

/// A sample of a pixel, or the ray through the pixel's centre, which is traced before the first
/// sample.
struct CameraSample {
    std::uint32_t pixel = 0, number = 0;
    bool centre = false;
};

float tent(float u) {
    const float v = 2 * u;
    return v < 1 ? std::sqrt(v) - 1 : 1 - std::sqrt(2 - v);
}

Eigen::Vector2f filtered(PixelFilter filter, const Eigen::Vector2f& u) {
    if (filter == PixelFilter::Tent) return {tent(u.x()), tent(u.y())};
    return u - Eigen::Vector2f(0.5F, 0.5F);
}

std::vector<MovedLight::Object> movingObjects(const Scene& scene) {
    std::vector<MovedLight::Object> out;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const SceneObject& object = scene.objects[i];
        const std::optional<ObjectBall> ball = ownBall(object);
        if (!object.path || !ball) continue;
        MovedLight::Object& moving = out.emplace_back();
        moving.id = static_cast<std::uint8_t>(i + 1);
        moving.own = *ball;
        for (const Mesh& mesh : meshesOf(object)) {
            const auto& material = object.model->materials[static_cast<std::size_t>(mesh.material)];
            moving.glow = std::max(moving.glow, luminanceOf<float>(material.emission));
        }
    }
    return out;
}

}  // namespace

void validate(const PathTracerOptions& o) {
    const auto require = [](bool sound, const char* rule) {
        if (!sound) throw std::invalid_argument(std::string("path tracer: ") + rule);
    };
    require(o.maxDepth >= 1 && o.maxDepth <= 64, "maxDepth must be from 1 to 64");
    require(o.rouletteDepth >= 1, "rouletteDepth must be at least 1");
    require(std::isfinite(o.fireflyClamp) && o.fireflyClamp >= 0,
            "fireflyClamp must be finite and not negative");
    require(std::isfinite(o.shadowReach) && o.shadowReach >= 1,
            "shadowReach must be finite and at least 1");
    require(o.buildThreads >= 1 && o.buildThreads <= 64, "buildThreads must be from 1 to 64");
}

struct PathTracer::Parts {
    Parts(std::shared_ptr<const Scene> sound, const PathTracerOptions& o)
        : options(o), scene(std::move(sound), o.buildThreads),
          light(std::make_shared<const DistantLight>(scene.scene())),
          integrator(scene, options, light), glow(glowDistance(scene.scene())),
          mirrors(std::make_shared<const MirrorLight>(integrator.mirrorLight())),
          moving(movingObjects(scene.scene())) {}
    Parts(const Parts& other, std::shared_ptr<const Scene> posed)
        : options(other.options), scene(other.scene, std::move(posed)), light(other.light),
          integrator(other.integrator, scene, options), glow(other.glow), mirrors(other.mirrors),
          moving(other.moving) {
        const std::scoped_lock lock(other.lensMutex);
        lenses = other.lenses;
    }

    [[nodiscard]] MovedLight movedSince(std::span<const RigidTransform> poses) const {
        std::vector<MovedLight::Object> objects = moving;
        for (MovedLight::Object& object : objects) {
            const std::size_t i = object.id - 1U;
            object.T_world_before = poses[i];
            object.T_world_now = scene.scene().objects[i].T_world_object;
        }
        return {objects, light->sun, light->far};
    }

    [[nodiscard]] std::shared_ptr<const LensRays> lensOf(const CameraModel& camera) const {
        const std::scoped_lock lock(lensMutex);
        for (const auto& known : lenses)
            if (known && known->camera() == camera) return known;
        std::rotate(lenses.begin(), lenses.end() - 1, lenses.end());
        return lenses.front() = std::make_shared<const LensRays>(camera);
    }

    PathTracerOptions options;
    TracedScene scene;
    std::shared_ptr<const DistantLight> light;
    PathIntegrator integrator;
    double glow;  ///< see glowDistance()
    std::shared_ptr<const MirrorLight> mirrors;
    std::vector<MovedLight::Object> moving;  ///< moving objects; their poses are not set
    mutable std::mutex lensMutex;
    /// The newest first. Portions of a picture and requests of missing pixels may alternate, with
    /// cameras of different resolution. There are five resolutions of pictures.
    mutable std::array<std::shared_ptr<const LensRays>, 6> lenses;
};

class PathTracer::Batch {
public:
    Batch(const Parts& parts, const RenderView& view, Film& film, const LightHistory* history)
        : parts_(parts), rays_(view, parts.lensOf(view.camera)),
          surfaces_(parts.scene, parts.integrator, rays_),
          width_(static_cast<std::uint32_t>(view.camera.size.width)), film_(film),
          history_(history) {}

    void add(const CameraSample& sample) {
        samples_[count_] = sample;
        batch_[count_] = rayOf(sample);
        if (++count_ == kBatch) flush();
    }

    void flush() {
        parts_.scene.objects().firstOfEach(std::span(batch_).first(count_),
                                           std::span(hits_).first(count_));
        for (std::size_t i = 0; i < count_; ++i)
            finish(samples_[i], batch_[i], hits_[i]);
        count_ = 0;
    }

private:
    [[nodiscard]] PixelSampler samplerOf(const CameraSample& sample) const {
        return {parts_.options.seed, sample.pixel, sample.number,
                parts_.options.independentSamples};
    }

    [[nodiscard]] Eigen::Vector2f positionOf(std::uint32_t pixel) const {
        return {pixel % width_, pixel / width_};
    }
    [[nodiscard]] Ray rayOf(const CameraSample& sample) const {
        Eigen::Vector2f at = positionOf(sample.pixel);
        if (!sample.centre) at += filtered(parts_.options.filter, samplerOf(sample).pair(0));
        return rays_.at(at);
    }

    void finish(const CameraSample& sample, const Ray& ray, const RayHit& first) {
        const TracedScene& scene = parts_.scene;
        const RayHit object = scene.shown(ray, first);
        const RayHit real =
            object.found() || scene.catcher().empty() ? RayHit{} : scene.catcher().first(ray);
        if (sample.centre) {
            look(sample.pixel, ray, object, real);
            return;
        }
        FilmSample out;
        if (object.found()) out.hit = {object.t, scene.idOf(object)};
        if (real.found()) out.hit = {real.t, kCatcherId};
        const PixelSampler sampler = samplerOf(sample);
        if (object.found()) {
            const auto light = parts_.integrator.ofObject(object, ray.direction, sampler);
            out.radiance = light.radiance;
            out.light = light.light;
            out.far = light.far;
            out.paint = light.paint;
        } else if (real.found()) {
            const auto light = parts_.integrator.ofCatcher(real, ray.direction, sampler);
            out.radiance = light.with;
            out.without = light.without;
        }
        film_.add(sample.pixel, out);
    }

    void look(std::uint32_t pixel, const Ray& ray, const RayHit& object, const RayHit& real) {
        const TracedScene& scene = parts_.scene;
        SeenSurface seen;
        if (object.found())
            seen = surfaces_.at(positionOf(pixel), ray, object);
        else if (real.found())
            seen = {{real.t, kCatcherId}, scene.catcherPoint(real, ray.direction).shading, {}, 1};
        film_.setCentre(pixel, seen);
        if (history_ != nullptr)
            film_.carry(pixel, history_->at(seen, rays_.eye() + seen.hit.depth * ray.direction,
                                            rays_.eye()));
    }

    const Parts& parts_;
    ViewRays rays_;
    PixelSurfaces surfaces_;
    std::uint32_t width_;
    Film& film_;
    const LightHistory* history_;
    std::size_t count_ = 0;
    std::array<CameraSample, kBatch> samples_;
    std::array<Ray, kBatch> batch_;
    std::array<RayHit, kBatch> hits_;
};

PathTracer::PathTracer(std::shared_ptr<const Scene> scene, const PathTracerOptions& options) {
    validate(options);
    if (!scene) throw std::invalid_argument("path tracer: there is no scene");
    validate(*scene);
    // Computes the albedo tables now. This takes as long as the first samples of a picture, and
    // would delay the first picture if it were done at first use.
    static_cast<void>(meanSpecularAlbedo(1));
    parts_ = std::make_unique<const Parts>(std::move(scene), options);
}

PathTracer::PathTracer(const PathTracer& other, std::shared_ptr<const Scene> posed)
    : parts_(std::make_unique<const Parts>(*other.parts_, std::move(posed))) {}

PathTracer::~PathTracer() = default;

std::unique_ptr<const PathTracer> PathTracer::posed(std::shared_ptr<const Scene> scene) const {
    return std::unique_ptr<const PathTracer>(new PathTracer(*this, std::move(scene)));
}

namespace {

void requireSound(const RenderView& view) {
    if (!isSound(view.camera))
        throw std::invalid_argument("view: the camera must have finite parameters, focal lengths "
                                    "above 0 and sides of 1 to 16384 pixels");
    if (!isFinite(view.T_world_camera) || !(view.T_world_camera.rotation.norm() > 0))
        throw std::invalid_argument(
            "view: the camera pose must be finite, and its rotation must not be zero");
}

}  // namespace

void PathTracer::trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
                       Film& film, const LightHistory* history) const {
    requireSound(view);
    if (!(film.size() == view.camera.size))
        throw std::invalid_argument("film: its size differs from the size of the view's camera");
    const auto count = static_cast<std::uint32_t>(film.size().width) *
                       static_cast<std::uint32_t>(film.size().height);
    if (!std::ranges::all_of(pixels, [count](std::uint32_t p) { return p < count; }))
        throw std::invalid_argument("film: a pixel to trace is outside the film");
    Batch batch(*parts_, view, film, history);
    constexpr std::size_t kAhead = 4;  // number of pixels by which Film::prefetch() runs ahead
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        if (p + kAhead < pixels.size()) film.prefetch(pixels[p + kAhead]);
        const std::uint32_t pixel = pixels[p];
        const std::uint32_t taken = film.samples(pixel);
        if (!film.isSeen(pixel)) batch.add({pixel, 0, true});
        for (int i = 0; i < samples; ++i)
            batch.add({pixel, taken + static_cast<std::uint32_t>(i), false});
    }
    batch.flush();
}

LightHistory PathTracer::historyOf(const Film& film, const RenderView& view, float mostSamples,
                                   std::span<const RigidTransform> poses) const {
    std::optional<MovedLight> moved;
    if (!poses.empty()) moved.emplace(parts_->movedSince(poses));
    return {film, view, parts_->lensOf(view.camera), mostSamples, std::move(moved)};
}

const std::shared_ptr<const MirrorLight>& PathTracer::mirrorLight() const {
    return parts_->mirrors;
}

std::optional<PathTracer::CatcherPoint> PathTracer::catcherAt(const RenderView& view,
                                                              const Eigen::Vector2f& pixel) const {
    const RayScene& catcher = parts_->scene.catcher();
    if (catcher.empty()) return {};
    const Eigen::Quaternionf turn = view.T_world_camera.rotation.cast<float>();
    const Eigen::Vector2f ray = parts_->lensOf(view.camera)->at(pixel.x(), pixel.y());
    const Ray look{view.T_world_camera.translation.cast<float>(), turn * ray.homogeneous().eval()};
    const RayHit hit = catcher.first(look);
    if (!hit.found()) return {};
    return CatcherPoint{look.origin + hit.t * look.direction,
                        parts_->scene.catcherPoint(hit, look.direction).shading};
}

PixelRect PathTracer::objectBounds(const RenderView& view) const {
    requireSound(view);
    const Eigen::AlignedBox3f& box = parts_->scene.objects().box();
    if (box.isEmpty()) return {};
    const PixelRect seen = pixelsOfBox(box, view, *parts_->lensOf(view.camera));
    return seen.empty() ? seen : widened(seen, 1, view.camera.size);
}

PixelRect PathTracer::bounds(const RenderView& view) const {
    requireSound(view);
    Eigen::AlignedBox3f box = parts_->scene.objects().box();
    if (box.isEmpty()) return {};
    const Eigen::AlignedBox3f& real = parts_->scene.catcher().box();
    const float diagonal = box.diagonal().norm();
    const float reach = 0.5F * parts_->options.shadowReach * diagonal *
                        static_cast<float>(glowReach(parts_->glow, diagonal));
    const Eigen::Vector3f side = Eigen::Vector3f::Constant(reach);
    const auto shaded =
        Eigen::AlignedBox3f(box.center() - side, box.center() + side).intersection(real);
    if (!real.isEmpty() && !shaded.isEmpty()) box.extend(shaded);
    const PixelRect seen = pixelsOfBox(box, view, *parts_->lensOf(view.camera));
    return seen.empty() ? seen : widened(seen, 1, view.camera.size);
}

}  // namespace mfar
