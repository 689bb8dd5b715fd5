#pragma once

#include "pipeline/render/lens_rays.h"
#include "pipeline/render/render_view.h"

#include <Eigen/Geometry>

namespace mfar {

/// Returns a rectangle that contains all pixels in which a point of `box` (world frame) appears.
/// The rectangle may be larger than necessary. `rays` must belong to `view`.
[[nodiscard]] PixelRect pixelsOfBox(const Eigen::AlignedBox3f& box, const RenderView& view,
                                    const LensRays& rays);

}  // namespace mfar
