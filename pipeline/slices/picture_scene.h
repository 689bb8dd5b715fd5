#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/scene/scene_bounds.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// A scene that is ready to be traced, at one instant.
struct PictureScene {
    struct MovingBall {
        std::size_t object;  ///< index of Scene::objects
        ObjectBall own;      ///< in the object's frame
    };

    std::shared_ptr<const PathTracer> tracer;
    std::shared_ptr<const Scene> source;  ///< the scene as it was set, at any instant
    std::vector<ObjectBall> balls;        ///< of the objects at this instant, in the world
    std::vector<MovingBall> moving;
    std::vector<RigidTransform> poses;  ///< T_world_object at this instant; empty if nothing moves
    std::uint64_t objects = 0, light = 0;

    [[nodiscard]] bool moves() const { return !moving.empty(); }
};

/// Throws the same exceptions as PathTracer.
[[nodiscard]] PictureScene pictureScene(std::shared_ptr<const Scene> source,
                                        const PathTracerOptions& options);
/// Returns the scene at another instant. It takes little time.
[[nodiscard]] std::shared_ptr<const PictureScene> posed(const PictureScene& scene,
                                                        std::vector<RigidTransform> poses);

}  // namespace mfar
