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

/// Unidirectional path tracing with next-event estimation of sun and environment, both combined
/// with the surface's own sampling by multiple importance sampling (Veach 1997). The camera sees
/// objects through the catcher; the composition decides whether the real surface occludes them.
class PathTracer {
public:
    /// Builds the search structure. Throws std::invalid_argument for an invalid scene, and
    /// std::runtime_error if Embree fails.
    explicit PathTracer(std::shared_ptr<const Scene> scene, const PathTracerOptions& options = {});
    ~PathTracer();
    PathTracer(const PathTracer&) = delete;
    PathTracer& operator=(const PathTracer&) = delete;

    /// Traces a ray through each listed pixel's centre and then `samples` samples of each listed
    /// pixel (row-major index, each once; the film's size is the camera's). Calls for disjoint
    /// pixels of a film may run at the same time. The result depends neither on that nor on how the
    /// samples are distributed over calls. Throws std::invalid_argument for a view that is not
    /// finite, a film of another size or a pixel outside it.
    void trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
               Film& film, const LightHistory* history = nullptr) const;

    /// Light in the film of an earlier picture of these objects; trace() carries it over.
    [[nodiscard]] LightHistory historyOf(const Film& film, const RenderView& view,
                                         float mostSamples) const;

    /// Distant light that the objects mirror.
    [[nodiscard]] const std::shared_ptr<const MirrorLight>& mirrorLight() const;

    /// The point of the catcher behind a pixel, ignoring objects.
    [[nodiscard]] std::optional<Eigen::Vector3f> catcherAt(const RenderView& view,
                                                           const Eigen::Vector2f& pixel) const;

    /// Rectangle around the pixels that an object may cover; may be larger, or empty.
    [[nodiscard]] PixelRect objectBounds(const RenderView& view) const;
    /// Rectangle around the pixels that an object, or the catcher within shadowReach of one, may
    /// cover; may be empty. Light that bounces farther is ignored.
    [[nodiscard]] PixelRect bounds(const RenderView& view) const;

private:
    struct Parts;
    class Batch;
    std::unique_ptr<const Parts> parts_;
};

}  // namespace mfar
