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

/// Unidirectional path tracing with next-event estimation for sun and environment. Multiple
/// importance sampling combines both with samples of the surface's reflection (Veach 1997). Objects
/// behind the shadow catcher are traced as if they were visible; the composition decides whether
/// the real surface occludes them.
class PathTracer {
public:
    /// Builds the search structure. Throws std::invalid_argument if the scene is invalid, and
    /// std::runtime_error if Embree fails.
    explicit PathTracer(std::shared_ptr<const Scene> scene, const PathTracerOptions& options = {});
    ~PathTracer();
    PathTracer(const PathTracer&) = delete;
    PathTracer& operator=(const PathTracer&) = delete;

    /// Traces one ray through the centre of each listed pixel and then `samples` samples of each
    /// listed pixel. `pixels` holds row-major indices, each only once; the film has the camera's
    /// size.
    /// Threads may trace disjoint pixels of a film at the same time. The result depends neither on
    /// the threads nor on how the samples are distributed over calls.
    /// Throws std::invalid_argument if the view is not finite, if the film has another size, or if
    /// a pixel is outside the film.
    void trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
               Film& film, const LightHistory* history = nullptr) const;

    /// Light in the film of an earlier picture of the same objects. trace() reuses this light.
    [[nodiscard]] LightHistory historyOf(const Film& film, const RenderView& view,
                                         float mostSamples) const;

    /// The distant light that the objects mirror.
    [[nodiscard]] const std::shared_ptr<const MirrorLight>& mirrorLight() const;

    /// The point of the shadow catcher that a pixel shows, ignoring objects.
    [[nodiscard]] std::optional<Eigen::Vector3f> catcherAt(const RenderView& view,
                                                           const Eigen::Vector2f& pixel) const;

    /// Rectangle around the pixels that an object may cover. It may be larger than necessary, or
    /// empty.
    [[nodiscard]] PixelRect objectBounds(const RenderView& view) const;
    /// Rectangle around the pixels that may show an object or the shadow catcher within shadowReach
    /// of an object. It may be empty. Light that objects reflect onto the catcher beyond
    /// shadowReach is ignored.
    [[nodiscard]] PixelRect bounds(const RenderView& view) const;

private:
    struct Parts;
    class Batch;
    std::unique_ptr<const Parts> parts_;
};

}  // namespace mfar
