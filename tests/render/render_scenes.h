#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/scene/scene.h"

#include <functional>
#include <memory>
#include <vector>

namespace mfar::render_scenes {

[[nodiscard]] Mesh sphere(const Eigen::Vector3f& centre, float radius, int rings = 32);
/// A square from (-side, -side) to (side, side) at height z that faces up.
[[nodiscard]] Mesh square(float side, float z);
/// A black material that emits light. It reflects only a little light, as black varnish does.
[[nodiscard]] Material lampOf(const Eigen::Vector3f& emission);
[[nodiscard]] ShadowCatcher ground(float side, float albedo);
[[nodiscard]] Model modelOf(Mesh mesh, const Material& material);
[[nodiscard]] SceneObject objectOf(Model model);
[[nodiscard]] std::shared_ptr<const Environment> evenLight(float radiance);
/// Light that is brighter towards +z, with a bright window on one side.
[[nodiscard]] std::shared_ptr<const Environment> unevenLight();

/// A pinhole camera at `eye` that looks at `target`. The top of its picture points to +z.
[[nodiscard]] RenderView lookingAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                                   Size size, double focal);

[[nodiscard]] std::vector<std::uint32_t> allPixels(Size size);
[[nodiscard]] Film traced(const PathTracer& tracer, const RenderView& view, int samples);
[[nodiscard]] RenderedPicture resolved(const Film& film, const RenderView& view);

}  // namespace mfar::render_scenes
