#pragma once

#include "pipeline/render/film.h"
#include "pipeline/render/path_tracer.h"
#include "pipeline/scene/scene.h"

#include <functional>
#include <memory>
#include <vector>

/// Small scenes with known light, and functions that trace them.
namespace mfar::render_scenes {

/// A sphere about `centre`, with vertices along latitudes and longitudes and with smooth normals.
[[nodiscard]] Mesh sphere(const Eigen::Vector3f& centre, float radius, int rings = 32);
/// A square with the corners (-side, -side) and (side, side) at height z. It faces up.
[[nodiscard]] Mesh square(float side, float z);
/// A shadow catcher that is the square of square(side, 0).
[[nodiscard]] ShadowCatcher ground(float side, float albedo);
[[nodiscard]] Model modelOf(Mesh mesh, const Material& material);
[[nodiscard]] SceneObject objectOf(Model model);
/// Light of constant radiance from all directions.
[[nodiscard]] std::shared_ptr<const Environment> evenLight(float radiance);
/// Light that is brighter towards +z, with a bright window on one side.
[[nodiscard]] std::shared_ptr<const Environment> unevenLight();

/// A pinhole camera at `eye` that looks at `target`. The top of its picture points towards +z.
[[nodiscard]] RenderView lookingAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                                   Size size, double focal);

[[nodiscard]] std::vector<std::uint32_t> allPixels(Size size);
/// Traces all pixels with `samples` samples each.
[[nodiscard]] Film traced(const PathTracer& tracer, const RenderView& view, int samples);
[[nodiscard]] RenderedPicture resolved(const Film& film, const RenderView& view);

}  // namespace mfar::render_scenes
