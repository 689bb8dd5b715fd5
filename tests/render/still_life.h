#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <memory>

namespace mfar::render_scenes {

/// Rough and shiny balls and boxes within 0.2 m of the origin. They stand on a shadow catcher.
/// A sun and unevenLight() light them.
[[nodiscard]] std::shared_ptr<const Scene> stillLife();

/// The still life in distant light of this radiance, equal from all directions, without a sun.
[[nodiscard]] std::shared_ptr<const Scene> stillLifeLitBy(const Eigen::Vector3f& radiance);

/// A camera that looks at the origin from a given `distance` [m]. `azimuth` is the angle about the
/// world's z axis from +x [degrees], `elevation` the angle above the plane [degrees].
[[nodiscard]] RenderView viewFrom(Size size, double azimuth, double elevation = 35,
                                  double distance = 0.9);

}  // namespace mfar::render_scenes
