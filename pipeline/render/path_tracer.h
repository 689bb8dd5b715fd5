#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace mfar {

/// The part of a pixel's surroundings that its samples are drawn from.
enum class PixelFilter {
    Box,   ///< the pixel itself
    Tent,  ///< falls to 0 at the neighbours' centres
};

struct PathTracerOptions {
    int maxDepth = 6;        ///< surfaces on a path, the camera's first included; [1, 64]
    int rouletteDepth = 3;   ///< surfaces after which a path may end by chance; at least 1
    float fireflyClamp = 0;  ///< limit of an indirect contribution's brightest channel; 0: none
    PixelFilter filter = PixelFilter::Box;
    std::uint32_t seed = 0;
    bool independentSamples = false;  ///< random numbers in place of the Sobol sequence
    float shadowReach = 3;  ///< objects' radii around them in which the catcher counts; at least 1
    int buildThreads = 1;   ///< for the search structure; [1, 64]
};

/// Throws std::invalid_argument that names the first option out of its range.
void validate(const PathTracerOptions& options);

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

    /// Adds `samples` more samples to each listed pixel (row-major index, each once; the film's
    /// size is the camera's). May run at the same time for disjoint pixels of a film. The result
    /// depends neither on that nor on how samples are cut into calls. Throws std::invalid_argument
    /// for a view that is not finite, a film of another size or a pixel outside it.
    void trace(const RenderView& view, std::span<const std::uint32_t> pixels, int samples,
               Film& film) const;

    /// Pixels that an object, or the catcher near one, may reach; may be empty.
    [[nodiscard]] PixelRect bounds(const RenderView& view) const;

private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

}  // namespace mfar
