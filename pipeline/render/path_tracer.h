#pragma once

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
/// objects through the catcher: whether the real surface hides them is the composition's to say.
class PathTracer {
public:
    /// Builds the search structure. Throws std::invalid_argument for an unsound scene, and
    /// std::runtime_error if Embree fails.
    explicit PathTracer(std::shared_ptr<const Scene> scene, const PathTracerOptions& options = {});
    ~PathTracer();
    PathTracer(const PathTracer&) = delete;
    PathTracer& operator=(const PathTracer&) = delete;

    /// Looks through each listed pixel's centre and, with `samples` above 0, adds as many samples
    /// to each listed pixel (row-major index, each once; the film's size is the camera's). May run
    /// at the same time for disjoint pixels of a film. The result depends neither on that nor on
    /// how samples are cut into calls. Throws std::invalid_argument for a view that is not finite,
    /// a film of another size or a pixel outside it.
    void trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
               Film& film, const LightHistory* history = nullptr) const;

    /// What the film of an earlier picture of these objects knows, for trace(), which carries it
    /// over.
    [[nodiscard]] LightHistory historyOf(const Film& film, const RenderView& view,
                                         float mostSamples) const;

    /// The point of the catcher behind a pixel, as if there were no objects.
    [[nodiscard]] std::optional<Eigen::Vector3f> catcherAt(const RenderView& view,
                                                           const Eigen::Vector2f& pixel) const;

    /// Pixels that an object may reach, or a few more; may be empty.
    [[nodiscard]] PixelRect objectBounds(const RenderView& view) const;
    /// Pixels that an object, or the catcher within shadowReach of one, may reach; may be empty.
    /// What bounces farther is left out.
    [[nodiscard]] PixelRect bounds(const RenderView& view) const;

private:
    struct Parts;
    class Batch;
    std::unique_ptr<const Parts> parts_;
};

}  // namespace mfar
