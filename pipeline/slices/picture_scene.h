#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/scene/scene_bounds.h"
#include "pipeline/slices/view_change.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mfar {

/// A scene that is ready to be traced, at one instant.
struct PictureScene {
    struct MovingBall {
        std::size_t object;  ///< index of Scene::objects
        ObjectBall own;      ///< ball around the object, in the object's frame
    };

    std::shared_ptr<const PathTracer> tracer;
    std::shared_ptr<const Scene> source;  ///< the scene as the caller set it, for all instants
    std::vector<ObjectBall> balls;        ///< balls around the objects at this instant, world frame
    std::optional<ObjectBall> shaded;     ///< ball around the shadow catcher, world frame
    std::vector<MovingBall> moving;
    std::vector<RigidTransform> poses;  ///< T_world_object at this instant; empty if nothing moves
    /// Version numbers. Both increase when the caller sets other objects or another shadow catcher.
    /// If the caller changes only the light, `light` alone increases.
    std::uint64_t objects = 0, light = 0;

    [[nodiscard]] bool moves() const { return !moving.empty(); }
    /// Returns viewChange() of the objects. If `to` shows no object, returns viewChange() of the
    /// shadow catcher instead, because shadows and glow can be visible without the objects.
    [[nodiscard]] double changeOf(const RenderView& from, const RenderView& to,
                                  const ViewLimits& limits) const;
    /// Estimated number of pixels through which rays are traced: all pixels around the objects, and
    /// a quarter of those that can only show a shadow.
    [[nodiscard]] double tracedPixels(const RenderView& view) const;
};

/// Throws the same exceptions as PathTracer.
[[nodiscard]] PictureScene pictureScene(std::shared_ptr<const Scene> source,
                                        const PathTracerOptions& options);
/// Returns the scene at another instant. It takes little time.
[[nodiscard]] std::shared_ptr<const PictureScene> posed(const PictureScene& scene,
                                                        std::vector<RigidTransform> poses);

}  // namespace mfar
