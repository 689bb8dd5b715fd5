#pragma once

#include "base/mirror_light.h"
#include "pipeline/render/film.h"
#include "pipeline/render/light_history.h"
#include "pipeline/render/path_tracer_options.h"
#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace mfar {

/// Unidirectional path tracer with next-event estimation for sun, environment and emissive
/// triangles. Multiple importance sampling combines light samples with samples of the surface's
/// reflection (Veach 1997). Objects behind the shadow catcher are traced as if they were visible;
/// the composition hides them where a real surface is in front.
class PathTracer {
public:
    /// Throws std::invalid_argument if the scene or an option is invalid, and std::runtime_error if
    /// Embree fails.
    explicit PathTracer(std::shared_ptr<const Scene> scene, const PathTracerOptions& options = {});
    /// Returns a tracer of the same scene with moving objects at other poses. It takes little time.
    /// `scene` must be a result of withPoses() for this tracer's scene.
    [[nodiscard]] std::unique_ptr<const PathTracer> posed(std::shared_ptr<const Scene> scene) const;
    ~PathTracer();
    PathTracer(const PathTracer&) = delete;
    PathTracer& operator=(const PathTracer&) = delete;

    /// First traces one ray through the centre of each listed pixel, unless an earlier call has
    /// done so. Then traces `samples` samples of each pixel. `pixels` holds row-major indices, each
    /// only once. Threads may trace disjoint pixels of a film at the same time. The result depends
    /// neither on the threads nor on the distribution of samples over calls. Throws
    /// std::invalid_argument if the view is invalid, the film's size differs from the camera's, or
    /// a pixel is outside the film.
    void trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
               Film& film, const LightHistory* history = nullptr) const;

    /// Returns the light of an earlier picture of the same objects, as an argument for trace().
    /// `film`, `view` and `poses` belong to that picture. `poses` are its objects' poses, or empty
    /// if no object moves.
    [[nodiscard]] LightHistory historyOf(const Film& film, const RenderView& view,
                                         float mostSamples,
                                         std::span<const RigidTransform> poses = {}) const;

    [[nodiscard]] const std::shared_ptr<const MirrorLight>& mirrorLight() const;

    struct CatcherPoint {
        Eigen::Vector3f position, normal;
    };
    [[nodiscard]] std::optional<CatcherPoint> catcherAt(const RenderView& view,
                                                        const Eigen::Vector2f& pixel) const;

    /// Rectangle around the pixels that an object may cover. It may be too large, or empty.
    [[nodiscard]] PixelRect objectBounds(const RenderView& view) const;
    /// Rectangle around the pixels that may show an object, or the shadow catcher near the objects.
    /// It may be empty. A point is near the objects if it is inside a cube around them. The cube's
    /// side is shadowReach * glowReach() times the diagonal of the objects' common box. On the
    /// catcher outside the cube, the light of objects is ignored.
    [[nodiscard]] PixelRect bounds(const RenderView& view) const;

private:
    struct Parts;
    class Batch;
    PathTracer(const PathTracer& other, std::shared_ptr<const Scene> posed);

    std::unique_ptr<const Parts> parts_;
};

}  // namespace mfar
