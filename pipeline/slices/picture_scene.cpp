#include "pipeline/slices/picture_scene.h"

#include "pipeline/scene/scene_parts.h"

#include <algorithm>
#include <utility>

namespace mfar {

double PictureScene::changeOf(const RenderView& from, const RenderView& to,
                              const ViewLimits& limits) const {
    if (!shaded || isSeen(balls, to)) return viewChange(from, to, balls, limits);
    return viewChange(from, to, {&*shaded, 1}, limits);
}

double PictureScene::tracedPixels(const RenderView& view) const {
    const double objects = static_cast<double>(tracer->objectBounds(view).area());
    return objects +
           0.25 * std::max(0.0, static_cast<double>(tracer->bounds(view).area()) - objects);
}

PictureScene pictureScene(std::shared_ptr<const Scene> source, const PathTracerOptions& options) {
    PictureScene out;
    out.tracer = std::make_shared<PathTracer>(source, options);
    out.balls = objectBalls(*source);
    out.shaded = catcherBall(*source);
    for (std::size_t i = 0; i < source->objects.size(); ++i) {
        const SceneObject& object = source->objects[i];
        if (!object.path) continue;
        if (const std::optional<ObjectBall> own = ownBall(object)) out.moving.push_back({i, *own});
    }
    if (out.moves())
        for (const SceneObject& object : source->objects)
            out.poses.push_back(object.T_world_object);
    out.source = std::move(source);
    return out;
}

std::shared_ptr<const PictureScene> posed(const PictureScene& scene,
                                          std::vector<RigidTransform> poses) {
    auto out = std::make_shared<PictureScene>(scene);
    auto at = std::make_shared<const Scene>(withPoses(*scene.source, poses));
    out->balls = objectBalls(*at);
    out->tracer = scene.tracer->posed(std::move(at));
    out->poses = std::move(poses);
    return out;
}

}  // namespace mfar
