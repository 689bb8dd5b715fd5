#pragma once

#include "pipeline/render/render_view.h"
#include "pipeline/scene/scene.h"

#include <memory>

namespace mfar::render_scenes {

/// Balls and boxes, rough and shiny, within 0.2 m of the origin on a plane that catches their
/// shadows, with a sun and unevenLight().
[[nodiscard]] std::shared_ptr<const Scene> stillLife();

/// A camera that looks at the origin, in metres and degrees: `azimuth` about the world's z from +x,
/// `elevation` above the plane.
[[nodiscard]] RenderView viewFrom(Size size, double azimuth, double elevation = 35,
                                  double distance = 0.9);

}  // namespace mfar::render_scenes
